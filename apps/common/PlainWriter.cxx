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

/** Whether an existing header says that its voxels are in the file of that name. */
bool
RefersTo(const fs::path & header, const std::string & dataName)
{
  std::error_code error;
  if (!fs::is_regular_file(header, error))
  {
    return false;
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
      return value == dataName || value == "./" + dataName;
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
PlainWriter::GetDataName() const
{
  constexpr std::size_t longest = 255;
  const std::string     ending = m_Options.Compress ? (m_IsNrrd ? ".raw.gz" : ".zraw") : ".raw";
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
  std::string dataName = m_IsDetached ? this->GetDataName() : m_IsNrrd ? "" : "LOCAL";
  dataName = m_IsDetached && dataName.rfind("LIST", 0) == 0 ? "./" + dataName : dataName;
  return m_IsNrrd ? ComposeNrrdHeader(m_Description, metadata, dataName, m_Options.Compress)
                  : ComposeMetaHeader(m_Description, metadata, dataName, m_Options.Compress);
}

void
PlainWriter::CheckDataName() const
{
  const fs::path  output = m_Folder->GetOutput();
  const fs::path  data = output.parent_path() / this->GetDataName();
  std::error_code error;
  if (fs::exists(fs::symlink_status(data, error)) && !RefersTo(output, data.filename().string()))
  {
    Fail(m_Path, "its voxels would replace the file " + data.string() + ", which is another image's");
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
    m_Folder->AllowReplacing(this->GetDataName());
    m_DataFile = std::make_unique<OutputFile>((file.parent_path() / this->GetDataName()).string(), m_Path);
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
  }
  m_Folder->Commit();
}
