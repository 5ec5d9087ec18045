// SPDX-License-Identifier: Apache-2.0
#include "headers/PlainHeader.h"
#include "outputs/TemporaryFolder.h"
#include "pieces/PieceWriter.h"
#include "system/files/OutputFile.h"
#include "volumes/BoxRuns.h"

#include <stdexcept>

namespace fs = std::filesystem;
using itk::Subdivision::Box;

namespace
{
class PlainPieceWriter : public PieceWriter
{
public:
  PlainPieceWriter(const std::string & path, const OutputOptions & options, WarningSink warn)
    : m_Path(path)
    , m_Output(ResolveOutput(path))
    , m_Options(options)
    , m_Warn(std::move(warn))
  {}

  std::vector<fs::path>
  GetReplacedFiles() const override
  {
    return ListReplacedFiles(m_Output, false);
  }

  bool
  WritesParts() const override
  {
    return true;
  }

  std::uint64_t
  GetScratchBytes(std::uint64_t) const override
  {
    return 0;
  }

  const fs::path &
  GetOutput() const override
  {
    return m_Output;
  }

  bool
  SplitsPlanes() const override
  {
    return true;
  }

  void
  Begin(const ImageDescription & description) override
  {
    std::error_code error;
    if (fs::exists(m_Output, error) && !fs::is_regular_file(m_Output, error))
    {
      this->Fail("it is not a regular file");
    }
    m_Description = description;
    m_Header = ComposePlainHeader(m_Output, description, m_Options);
    m_DataOffset = m_Header.IsDetached ? 0 : m_Header.Text.size();
    this->CheckDataFile();
    if (m_Header.IsDetached)
    {
      WarnOfLinkToPair(m_Path, m_Warn);
    }
  }

  void
  LayOut(const fs::path & folder) const override
  {
    OutputFile header((folder / m_Output.filename()).string(), m_Path);
    header.WriteAt(0, m_Header.Text.data(), m_Header.Text.size());
    const std::uint64_t size = m_Description.GetBytes();
    if (m_Header.IsDetached)
    {
      OutputFile(this->GetDataFile(folder).string(), m_Path).SetSize(size);
    }
    else
    {
      header.SetSize(m_DataOffset + size);
    }
    header.BringToDisk();
  }

  void
  Open(const fs::path & folder, const fs::path &, const Piece & piece) override
  {
    m_Folder = folder;
    m_Piece = piece;
    m_Checksum = 0;
    m_Data = std::make_unique<OutputFile>(this->GetDataFile(folder).string(), m_Path, OutputFile::Opening::Shared);
    this->ForEachRange(piece,
                       [this](std::uint64_t offset, std::uint64_t count) { m_Data->ReserveRange(offset, count); });
  }

  void
  Write(const Box & box, const void * voxels) override
  {
    const char * bytes = static_cast<const char *>(voxels);
    this->ForEachRange({ box }, [&](std::uint64_t offset, std::uint64_t count) {
      m_Data->WriteAt(offset, bytes, count);
      m_Checksum = AddToChecksum(m_Checksum, bytes, count);
      bytes += count;
    });
  }

  void
  Commit() override
  {
    m_Data->BringToDisk();
    m_Data.reset();
    if (this->ReadChecksum(m_Folder, m_Piece) != m_Checksum)
    {
      this->Fail("what is read back is not what was written");
    }
  }

  std::uint32_t
  ReadChecksum(const fs::path & folder, const Piece & piece) const override
  {
    std::uint32_t checksum = 0;
    this->ForEachRange(piece, [&](std::uint64_t offset, std::uint64_t count) {
      checksum = AddToChecksum(checksum, this->GetDataFile(folder), offset, count);
    });
    return checksum;
  }

  void
  CheckAll(const fs::path & folder) const override
  {
    CheckPlainFile((folder / m_Output.filename()).string(), m_Path, m_Description);
    this->CheckDataFile();
  }

  std::optional<DetachedPair>
  FindPair(const fs::path & folder) const override
  {
    const auto compose = [this](const std::string & dataName) {
      return ComposePlainHeader(m_Output, m_Description, m_Options, dataName).Text;
    };
    return m_Header.IsDetached ? std::optional<DetachedPair>({ folder, m_Output, m_Header.DataName, compose })
                               : std::nullopt;
  }

  std::optional<fs::path>
  FindOldData() const override
  {
    return m_Header.IsDetached ? FindOldDataFile(m_Output, false) : std::nullopt;
  }

private:
  [[noreturn]] void
  Fail(const std::string & reason) const
  {
    throw std::runtime_error("cannot write " + m_Path + ": " + reason);
  }

  void
  CheckDataFile() const
  {
    if (m_Header.IsDetached)
    {
      ::CheckDataFile(m_Output, m_Header.DataName);
    }
  }

  fs::path
  GetDataFile(const fs::path & folder) const
  {
    return folder / (m_Header.IsDetached ? fs::path(m_Header.DataName) : m_Output.filename());
  }

  /** Calls a function with the offset and the number of bytes of each range of the data file that a piece occupies. */
  template <typename TFunction>
  void
  ForEachRange(const Piece & piece, TFunction && function) const
  {
    const std::uint64_t voxelBytes = m_Description.GetVoxelBytes();
    for (const Box & box : piece)
    {
      ForEachRun(m_Description.Grid.Size, box, [&](std::uint64_t first, std::uint64_t count) {
        function(m_DataOffset + first * voxelBytes, count * voxelBytes);
      });
    }
  }

  std::string                 m_Path;
  fs::path                    m_Output;
  OutputOptions               m_Options;
  WarningSink                 m_Warn;
  ImageDescription            m_Description;
  PlainHeader                 m_Header;
  std::uint64_t               m_DataOffset = 0;
  fs::path                    m_Folder;
  Piece                       m_Piece;
  std::unique_ptr<OutputFile> m_Data;
  std::uint32_t               m_Checksum = 0;
};
} // namespace

std::unique_ptr<PieceWriter>
CreatePlainPieceWriter(const std::string & path, const OutputOptions & options, const WarningSink & warn)
{
  return std::make_unique<PlainPieceWriter>(path, options, warn);
}
