// SPDX-License-Identifier: Apache-2.0
#include "PlainWriter.h"
#include "BoxRuns.h"
#include "HeaderText.h"
#include "InputFile.h"
#include "MetaHeader.h"
#include "Metadata.h"
#include "NrrdHeader.h"

#include <stdexcept>

namespace fs = std::filesystem;

namespace
{
[[noreturn]] void
Fail(const std::string & path, const std::string & reason)
{
  throw std::runtime_error("cannot write " + path + ": " + reason);
}

/** What an existing header calls the file of its voxels; empty if it does not exist or names none. */
std::string
ReadDataName(const fs::path & header)
{
  std::error_code error;
  if (!fs::is_regular_file(header, error))
  {
    return {};
  }
  const std::string text = InputFile(header.string()).ReadTextAt(0, 1 << 20) + "\n";
  for (std::size_t start = 0, end = 0; (end = text.find('\n', start)) != std::string::npos; start = end + 1)
  {
    const std::string line = text.substr(start, end - start);
    const auto        separator = line.find_first_of("=:");
    const std::string key = separator == std::string::npos ? "" : ToLower(Trim(line.substr(0, separator)));
    if (key == "elementdatafile" || key == "data file" || key == "datafile")
    {
      const std::string value = Trim(line.substr(separator + 1));
      return value.rfind("./", 0) == 0 ? value.substr(2) : value;
    }
  }
  return {};
}

/** Whether a file may hold the voxels of another image in its folder: whether a header there, other than that one, has
 * its name or names files by a pattern or a list. One that cannot be read might. */
bool
IsNamedByAnother(const fs::path & data, const fs::path & header)
{
  for (const fs::directory_entry & entry : fs::directory_iterator(data.parent_path()))
  {
    const std::string ending = ToLower(entry.path().extension().string());
    std::error_code   error;
    if (entry.path() == header || !entry.is_regular_file(error) ||
        (ending != ".mhd" && ending != ".nhdr" && ending != ".mha" && ending != ".nrrd"))
    {
      continue;
    }
    try
    {
      const std::string name = ReadDataName(entry.path());
      if (fs::path(name).filename() == data.filename() || name.rfind("LIST", 0) == 0 ||
          name.find('%') != std::string::npos)
      {
        return true;
      }
    }
    catch (const std::runtime_error &)
    {
      return true;
    }
  }
  return false;
}
} // namespace

PlainWriter::PlainWriter(const std::string & path, const OutputOptions & options, const WarningSink & warn)
  : m_Path(path)
  , m_Options(options)
  , m_Warn(warn)
{
  const std::string ending = ToLower(fs::path(path).extension().string());
  m_IsNrrd = ending == ".nrrd" || ending == ".nhdr";
  m_IsDetached = ending == ".mhd" || ending == ".nhdr";
}

PlainWriter::~PlainWriter() = default;

bool
PlainWriter::WritesParts() const
{
  return true;
}

std::uint64_t
PlainWriter::GetScratchBytes(std::uint64_t) const
{
  return m_Options.Compress ? ParallelDeflate::GetScratchBytes(m_Options.Threads) : 0;
}

/** A name that no reader takes for a list, a pattern or several words, and that the file system can hold. */
std::string
PlainWriter::GetDataName(const bool isCompressed) const
{
  constexpr std::size_t longest = 255;
  const std::string     ending = isCompressed ? (m_IsNrrd ? ".raw.gz" : ".zraw") : ".raw";
  std::string           stem = m_Folder->GetFileName().stem().string();
  stem.resize(std::min(stem.size(), longest - ending.size()));
  for (char & c : stem)
  {
    const auto code = static_cast<unsigned char>(c);
    c = code < ' ' || code == 0x7f || c == '%' ? '_' : c;
  }
  if (stem.front() == ' ')
  {
    stem.front() = '_';
  }
  return stem + ending;
}

std::string
PlainWriter::ComposeHeader() const
{
  const auto style = m_IsNrrd ? MetadataStyle::Nrrd : MetadataStyle::MetaImage;
  const auto metadata = SelectMetadata(m_Description, style, m_Options.KeepMetadata);
  // A name that starts with LIST would mean a list of names.
  std::string dataName = m_IsDetached ? this->GetDataName(m_Options.Compress) : m_IsNrrd ? "" : "LOCAL";
  dataName = m_IsDetached && dataName.rfind("LIST", 0) == 0 ? "./" + dataName : dataName;
  return m_IsNrrd ? ComposeNrrdHeader(m_Description, metadata, dataName, m_Options.Compress)
                  : ComposeMetaHeader(m_Description, metadata, dataName, m_Options.Compress);
}

void
PlainWriter::CheckDataName() const
{
  const fs::path  output = m_Folder->GetOutput();
  const fs::path  data = output.parent_path() / this->GetDataName(m_Options.Compress);
  std::error_code error;
  if (fs::exists(fs::symlink_status(data, error)) && ReadDataName(output) != data.filename().string())
  {
    Fail(m_Path, "its voxels would replace the file " + data.string() + ", which is another image's");
  }
}

/** The header that is replaced may name the compressed voxels where this one names plain ones, or the other way round:
 * they would be nobody's, and in the way of a later output. */
void
PlainWriter::RemoveOldData()
{
  const fs::path  output = m_Folder->GetOutput();
  const fs::path  data = output.parent_path() / this->GetDataName(!m_Options.Compress);
  std::error_code error;
  if (ReadDataName(output) == data.filename().string() && fs::is_regular_file(fs::symlink_status(data, error)) &&
      !IsNamedByAnother(data, output))
  {
    m_Folder->RemoveAfterwards(data.filename().string());
  }
}

void
PlainWriter::Begin(const ImageDescription & description)
{
  m_Description = description;
  m_Folder = std::make_unique<TemporaryFolder>(m_Path, m_Warn);
  m_Header = this->ComposeHeader();
  const fs::path file = m_Folder->GetFileName();
  m_HeaderFile = std::make_unique<OutputFile>(file.string(), m_Path);
  m_DataOffset = m_IsDetached ? 0 : m_Header.size();
  if (m_IsDetached)
  {
    this->CheckDataName();
    m_Folder->AllowReplacing(this->GetDataName(m_Options.Compress));
    m_DataFile =
      std::make_unique<OutputFile>((file.parent_path() / this->GetDataName(m_Options.Compress)).string(), m_Path);
  }
  OutputFile & data = m_DataFile != nullptr ? *m_DataFile : *m_HeaderFile;
  m_BytesWritten = m_CompressedBytes = 0;
  if (!m_Options.Compress)
  {
    data.Reserve(m_DataOffset + m_Description.GetNumberOfVoxels() * m_Description.GetVoxelBytes());
    return;
  }
  m_Deflate =
    std::make_unique<ParallelDeflate>(m_IsNrrd ? ParallelDeflate::Wrapper::Gzip : ParallelDeflate::Wrapper::Zlib,
                                      m_Options.CompressionLevel,
                                      m_Options.Threads,
                                      [this, &data](const void * bytes, std::size_t count) {
                                        data.WriteAt(m_DataOffset + m_CompressedBytes, bytes, count);
                                        m_CompressedBytes += count;
                                      });
}

void
PlainWriter::Write(const itk::Subdivision::Box & box, const void * voxels)
{
  const std::uint64_t voxelBytes = m_Description.GetVoxelBytes();
  OutputFile &        data = m_DataFile != nullptr ? *m_DataFile : *m_HeaderFile;
  const char *        bytes = static_cast<const char *>(voxels);
  ForEachRun(m_Description.Grid.Size, box, [&](std::uint64_t first, std::uint64_t count) {
    if (m_Deflate == nullptr)
    {
      data.WriteAt(m_DataOffset + first * voxelBytes, bytes, count * voxelBytes);
    }
    else if (first * voxelBytes == m_BytesWritten)
    {
      m_Deflate->Write(bytes, count * voxelBytes);
    }
    else
    {
      Fail(m_Path, "compressed voxels can only be written in order");
    }
    bytes += count * voxelBytes;
    m_BytesWritten += count * voxelBytes;
  });
}

/** Reads the header as it is found by others, and the sizes of the files with it. */
void
PlainWriter::CheckHeader() const
{
  const std::string file = m_Folder->GetFileName().string();
  try
  {
    const PlainLayout layout = m_IsNrrd ? ReadNrrdHeader(file) : ReadMetaHeader(file);
    if (layout.Description.Grid.Size == m_Description.Grid.Size &&
        layout.Description.GetVoxelBytes() == m_Description.GetVoxelBytes())
    {
      return;
    }
  }
  catch (const std::runtime_error & error)
  {
    Fail(m_Path, std::string("it is not whole: ") + error.what());
  }
  Fail(m_Path, "its header is not what was meant");
}

void
PlainWriter::Commit()
{
  if (m_BytesWritten != m_Description.GetNumberOfVoxels() * m_Description.GetVoxelBytes())
  {
    Fail(m_Path, "not all voxels were written");
  }
  if (m_Deflate != nullptr)
  {
    m_Deflate->Finish();
    if (!m_IsNrrd)
    {
      FillInCompressedSize(m_Header, m_CompressedBytes);
    }
  }
  m_HeaderFile->WriteAt(0, m_Header.data(), m_Header.size());
  m_HeaderFile.reset();
  m_DataFile.reset();
  this->CheckHeader();
  if (m_IsDetached)
  {
    this->CheckDataName();
    this->RemoveOldData();
  }
  m_Folder->Commit();
}
