// SPDX-License-Identifier: Apache-2.0
#include "plain/PlainWriter.h"
#include "headers/MetaHeader.h"
#include "system/files/FolderLock.h"
#include "volumes/BoxRuns.h"

#include <optional>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{
[[noreturn]] void
Fail(const std::string & path, const std::string & reason)
{
  throw std::runtime_error("cannot write " + path + ": " + reason);
}
} // namespace

PlainWriter::PlainWriter(const std::string & path, const OutputOptions & options, const WarningSink & warn)
  : m_Path(path)
  , m_Options(options)
  , m_Warn(warn)
{}

PlainWriter::~PlainWriter() = default;

std::vector<fs::path>
PlainWriter::GetReplacedFiles() const
{
  return ListReplacedFiles(ResolveOutput(m_Path), m_Options.Compress);
}

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

void
PlainWriter::Begin(const ImageDescription & description)
{
  m_Description = description;
  m_Folder = std::make_unique<TemporaryFolder>(m_Path, m_Warn);
  m_Header = ComposePlainHeader(m_Folder->GetFileName(), description, m_Options);
  const fs::path file = m_Folder->GetFileName();
  m_HeaderFile = std::make_unique<OutputFile>(file.string(), m_Path);
  m_DataOffset = m_Header.IsDetached ? 0 : m_Header.Text.size();
  if (m_Header.IsDetached)
  {
    WarnOfLinkToPair(m_Path, m_Warn);
    // Not while another run has named its voxels, and its header not yet.
    const FolderLock alone(m_Folder->GetOutput().parent_path());
    CheckDataFile(m_Folder->GetOutput(), m_Header.DataName);
    m_Folder->AllowReplacing(m_Header.DataName);
    m_DataFile = std::make_unique<OutputFile>((file.parent_path() / m_Header.DataName).string(), m_Path);
  }
  OutputFile & data = m_DataFile != nullptr ? *m_DataFile : *m_HeaderFile;
  m_BytesWritten = m_CompressedBytes = 0;
  if (!m_Options.Compress)
  {
    if (data.Reserve(m_DataOffset + m_Description.GetBytes()) && m_Folder->RelyOnRoom())
    {
      data.DoNotHurry();
    }
    return;
  }
  m_Deflate =
    std::make_unique<ParallelDeflate>(m_Header.IsNrrd ? ParallelDeflate::Wrapper::Gzip : ParallelDeflate::Wrapper::Zlib,
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

std::string
PlainWriter::ComposeHeader(const std::string & dataName) const
{
  PlainHeader header = ComposePlainHeader(m_Folder->GetFileName(), m_Description, m_Options, dataName);
  if (m_Deflate != nullptr && !header.IsNrrd)
  {
    FillInCompressedSize(header.Text, m_CompressedBytes);
  }
  return header.Text;
}

void
PlainWriter::Commit()
{
  if (m_BytesWritten != m_Description.GetBytes())
  {
    Fail(m_Path, "not all voxels were written");
  }
  if (m_Deflate != nullptr)
  {
    m_Deflate->Finish();
  }
  m_Header.Text = this->ComposeHeader(m_Header.DataName);
  m_HeaderFile->WriteAt(0, m_Header.Text.data(), m_Header.Text.size());
  m_HeaderFile->Close();
  if (m_DataFile != nullptr)
  {
    m_DataFile->Close();
  }
  CheckPlainFile(m_Folder->GetFileName().string(), m_Path, m_Description);
  std::optional<FolderLock> alone; // another run to the same output would mix its header with these voxels
  if (m_Header.IsDetached)
  {
    alone.emplace(m_Folder->GetOutput().parent_path());
    CheckDataFile(m_Folder->GetOutput(), m_Header.DataName);
    if (const auto old = FindOldDataFile(m_Folder->GetOutput(), m_Options.Compress))
    {
      m_Folder->RemoveAfterwards(old->filename().string());
    }
    m_Folder->NameDataBy(m_Header.DataName, [this](const std::string & name) { return this->ComposeHeader(name); });
  }
  m_Folder->Commit();
}
