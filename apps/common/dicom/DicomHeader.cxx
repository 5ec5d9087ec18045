// SPDX-License-Identifier: Apache-2.0
#include "dicom/DicomHeader.h"
#include "dicom/DicomFrames.h"
#include "dicom/DicomTags.h"

#include "gdcmFile.h"
#include "gdcmMediaStorage.h"
#include "gdcmReader.h"
#include "gdcmStringFilter.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{
using Tag = gdcm::Tag;

const Tag PixelDataTag(0x7fe0, 0x0010);

[[noreturn]] void
Fail(const fs::path & path, const std::string & reason)
{
  throw std::runtime_error("cannot read " + path.string() + ": " + reason);
}

/** Bytes of a file from the place on that was read to; nothing if its end was reached. */
std::optional<std::uint64_t>
GetBytesLeft(std::istream & file, std::uint64_t size)
{
  const std::streamoff place = file.good() ? static_cast<std::streamoff>(file.tellg()) : -1;
  return place < 0 || static_cast<std::uint64_t>(place) >= size
           ? std::nullopt
           : std::optional<std::uint64_t>(size - static_cast<std::uint64_t>(place));
}

/** Whether all fragments of compressed voxels, which come next in the file, are there. GDCM would decode a part of them
 * without a word. */
bool
HasAllFragments(std::istream & file, std::uint64_t size)
{
  while (true)
  {
    std::array<unsigned char, 8> item{};
    file.read(reinterpret_cast<char *>(item.data()), item.size());
    constexpr std::array<unsigned char, 4> fragment = { 0xfe, 0xff, 0x00, 0xe0 };
    constexpr std::array<unsigned char, 4> end = { 0xfe, 0xff, 0xdd, 0xe0 };
    if (file && std::equal(end.begin(), end.end(), item.begin()))
    {
      return true;
    }
    if (!file || !std::equal(fragment.begin(), fragment.end(), item.begin()))
    {
      return file.eof() && file.gcount() == 0; // some writers leave the end mark out
    }
    const std::uint64_t length =
      item[4] + (std::uint64_t{ item[5] } << 8) + (std::uint64_t{ item[6] } << 16) + (std::uint64_t{ item[7] } << 24);
    const auto left = GetBytesLeft(file, size);
    if (length > left.value_or(0))
    {
      return false;
    }
    file.seekg(static_cast<std::streamoff>(length), std::ios::cur);
  }
}

/** Whether all voxels, which come next in the file, are there. */
bool
HasAllVoxels(const DicomHeader & header, std::istream & file)
{
  const std::uint64_t size = fs::file_size(header.FileName);
  const auto          left = GetBytesLeft(file, size);
  if (!left || header.IsCompressed)
  {
    return left && HasAllFragments(file, size);
  }
  return *left >= header.GetFrameBytes() * header.Frames.size();
}

/** Whether the file says that it is DICOM: by the letters behind the preamble, or by its name's ending. */
bool
ClaimsToBeDicom(const fs::path & path)
{
  std::ifstream file(path, std::ios::binary);
  char          start[132] = {};
  file.read(start, sizeof(start));
  if (file && std::equal(start + 128, start + 132, "DICM"))
  {
    return true;
  }
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return path.filename().string().front() != '.' && (ending == ".dcm" || ending == ".dicom" || ending == ".ima");
}

/** Whether a file says that it holds an image of a patient, of a kind that always has rows and columns. */
bool
ClaimsToBeImage(const gdcm::File & file)
{
  // GDCM counts overlays, curves, tables and registrations among the images.
  constexpr std::array<const char *, 7> others = { "8", "9", "9.1.3", "10", "11", "66.1", "66.2" };
  const std::string                     start = "1.2.840.10008.5.1.4.1.1.";
  gdcm::MediaStorage                    storage;
  storage.SetFromFile(file);
  const char * const name = gdcm::MediaStorage::GetMSString(storage);
  const std::string  kind = name == nullptr ? "" : name;
  return gdcm::MediaStorage::IsImage(storage) && kind.rfind(start, 0) == 0 &&
         std::find(others.begin(), others.end(), kind.substr(start.size())) == others.end();
}

[[noreturn]] void
FailOfDamage(const fs::path & path)
{
  Fail(path, "the DICOM file is damaged; if it does not belong to the volume, move it elsewhere");
}

DicomHeader
ReadAttributes(const gdcm::DataSet & data)
{
  DicomHeader header;
  header.SeriesUid = GetDicomText(data, Tag(0x0020, 0x000e));
  header.InstanceUid = GetDicomText(data, Tag(0x0008, 0x0018));
  header.Description = GetDicomText(data, Tag(0x0008, 0x103e));
  header.Modality = GetDicomText(data, Tag(0x0008, 0x0060));
  header.Photometric = GetDicomText(data, Tag(0x0028, 0x0004));
  header.SeriesNumber = GetDicomNumber(data, Tag(0x0020, 0x0011)).value_or(0);
  header.InstanceNumber = GetDicomNumber(data, Tag(0x0020, 0x0013));
  header.Rows = GetDicomShort(data, Tag(0x0028, 0x0010)).value_or(0);
  header.Columns = GetDicomShort(data, Tag(0x0028, 0x0011)).value_or(0);
  header.Samples = GetDicomShort(data, Tag(0x0028, 0x0002)).value_or(1);
  header.BitsAllocated = GetDicomShort(data, Tag(0x0028, 0x0100)).value_or(0);
  header.BitsStored = GetDicomShort(data, Tag(0x0028, 0x0101)).value_or(header.BitsAllocated);
  header.HighBit = GetDicomShort(data, Tag(0x0028, 0x0102)).value_or(header.BitsStored - 1);
  header.IsSigned = GetDicomShort(data, Tag(0x0028, 0x0103)).value_or(0) == 1;
  header.HasValueTable = data.FindDataElement(Tag(0x0028, 0x3000));
  header.HasRealPixels = data.FindDataElement(Tag(0x7fe0, 0x0008)) || data.FindDataElement(Tag(0x7fe0, 0x0009));
  ReadDicomFrames(data, header);
  return header;
}
} // namespace

std::optional<DicomHeader>
ReadDicomHeader(const fs::path & path)
{
  std::ifstream file(path, std::ios::binary);
  if (!file)
  {
    Fail(path, std::strerror(errno));
  }
  const bool     isClaimed = ClaimsToBeDicom(path);
  constexpr auto startBytes = 132; // the preamble and the letters
  if (isClaimed && fs::file_size(path) <= startBytes)
  {
    FailOfDamage(path); // GDCM would abort
  }
  gdcm::Reader reader;
  reader.SetStream(file);
  if (!reader.CanRead() || !reader.ReadUpToTag(PixelDataTag, { PixelDataTag }))
  {
    if (isClaimed)
    {
      FailOfDamage(path);
    }
    return std::nullopt;
  }
  const gdcm::DataSet & data = reader.GetFile().GetDataSet();
  if (!data.FindDataElement(Tag(0x0028, 0x0010)) || !data.FindDataElement(Tag(0x0028, 0x0011)))
  {
    if (ClaimsToBeImage(reader.GetFile()))
    {
      FailOfDamage(path);
    }
    return std::nullopt;
  }
  try
  {
    DicomHeader header = ReadAttributes(data);
    header.FileName = path;
    const gdcm::TransferSyntax & syntax = reader.GetFile().GetHeader().GetDataSetTransferSyntax();
    header.IsCompressed = syntax.IsEncapsulated();
    header.IsBigEndian = syntax.GetSwapCode() == gdcm::SwapCode::BigEndian;
    const bool isDeflated = syntax == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian;
    header.IsTruncated = !isDeflated && !HasAllVoxels(header, file); // deflated, its places are not those of the file
    return header;
  }
  catch (const std::runtime_error & error)
  {
    const std::string reason = error.what();
    reason.rfind("cannot read ", 0) == 0 ? throw : Fail(path, reason);
  }
}

std::map<std::string, std::string>
ReadDicomMetadata(const fs::path & path)
{
  gdcm::Reader reader;
  reader.SetFileName(path.c_str());
  std::map<std::string, std::string> metadata;
  if (!reader.ReadUpToTag(PixelDataTag, { PixelDataTag }))
  {
    return metadata;
  }
  gdcm::StringFilter text;
  text.SetFile(reader.GetFile());
  for (const gdcm::DataElement & element : reader.GetFile().GetDataSet().GetDES())
  {
    // Plain values alone: no sequences, no bulk data.
    constexpr unsigned int longest = 1024;
    const auto *           bytes = element.GetByteValue();
    if (bytes != nullptr && bytes->GetLength() <= longest && !element.GetTag().IsPrivate())
    {
      metadata[element.GetTag().PrintAsPipeSeparatedString()] = text.ToString(element.GetTag());
    }
  }
  const gdcm::DataSet & data = reader.GetFile().GetDataSet();
  const std::string     modality = GetDicomText(data, Tag(0x0008, 0x0060));
  if (!modality.empty())
  {
    metadata["Modality"] = modality;
  }
  for (const Tag & tag : { Tag(0x0028, 0x1054), Tag(0x0054, 0x1001), Tag(0x3004, 0x0002) })
  {
    const std::string unit = GetDicomText(data, tag);
    if (!unit.empty() && metadata.count("Units") == 0)
    {
      metadata["Units"] = unit;
    }
  }
  return metadata;
}
