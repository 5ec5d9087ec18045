// SPDX-License-Identifier: Apache-2.0
#include "tiff/TiffWriter.h"
#include "outputs/TemporaryFolder.h"
#include "system/files/DiskRoom.h"
#include "tiff/TiffPageWriter.h"
#include "tiff/TiffReader.h"

#include <filesystem>
#include <stdexcept>

using itk::Subdivision::Box;

namespace
{
class TiffWriter : public VolumeWriter
{
public:
  TiffWriter(const std::string & path, const OutputOptions & options, WarningSink warn)
    : m_Path(path)
    , m_Options(options)
    , m_Warn(std::move(warn))
  {}

  std::vector<std::filesystem::path>
  GetReplacedFiles() const override
  {
    return { ResolveOutput(m_Path) };
  }

  bool
  WritesParts() const override
  {
    return true;
  }

  std::uint64_t
  GetScratchBytes(std::uint64_t) const override
  {
    return std::uint64_t{ 1 } << 20; // a strip, as it is and compressed, and a row
  }

  void
  Begin(const ImageDescription & description) override;
  void
  Write(const Box & box, const void * voxels) override;
  void
  Commit() override;

private:
  [[noreturn]] void
  Fail(const std::string & reason) const
  {
    throw std::runtime_error("cannot write " + m_Path + ": " + reason);
  }

  std::string                      m_Path;
  OutputOptions                    m_Options;
  WarningSink                      m_Warn;
  ImageDescription                 m_Description;
  std::uint64_t                    m_Slices = 1;
  std::uint64_t                    m_Complete = 0; // slices
  std::uint64_t                    m_Rows = 0;     // of the slice that is being written
  std::unique_ptr<TemporaryFolder> m_Folder;
  std::unique_ptr<TiffPageWriter>  m_Pages;
};

void
TiffWriter::Begin(const ImageDescription & description)
{
  CheckForTiff(m_Path, description, m_Warn);
  m_Description = description;
  m_Slices = description.Grid.Size.size() > 2 ? description.Grid.Size[2] : 1;
  m_Folder = std::make_unique<TemporaryFolder>(m_Path, m_Warn);

  if (!m_Options.Compress)
  {
    CheckFreeBytes(m_Path, m_Folder->GetFileName().parent_path(), description.GetBytes());
  }
  const std::uint64_t     headers = 1000 * m_Slices + description.GetBytes() / 1000;
  constexpr std::uint64_t most = 4000000000u; // offsets have 32 bits
  const bool              isBig = description.GetBytes() + headers > most;
  m_Pages = std::make_unique<TiffPageWriter>(m_Folder->GetFileName().string(), m_Path, description, m_Options, isBig);
}

void
TiffWriter::Write(const Box & box, const void * voxels)
{
  const ImageGrid &   grid = m_Description.Grid;
  const std::uint64_t first = box.size() > 2 ? static_cast<std::uint64_t>(box[2].First) : 0;
  const std::uint64_t count = box.size() > 2 ? box[2].Size : 1;
  const std::uint64_t rows = box[1].Size;
  const bool          isNext = first == m_Complete && static_cast<std::uint64_t>(box[1].First) == m_Rows;
  if (!isNext || box[0].Size != grid.Size[0] || (count > 1 && rows != grid.Size[1]))
  {
    this->Fail("its parts do not continue each other");
  }
  const auto * bytes = static_cast<const unsigned char *>(voxels);
  for (std::uint64_t slice = 0; slice < count; ++slice)
  {
    if (m_Rows == 0)
    {
      m_Pages->BeginPage(m_Complete == 0 ? MakeImageJText(m_Description, m_Slices) : "");
    }
    m_Pages->WriteRows(bytes + slice * rows * grid.Size[0] * m_Description.GetVoxelBytes(), rows);
    m_Rows += rows;
    if (m_Rows == grid.Size[1])
    {
      m_Pages->EndPage();
      m_Rows = 0;
      ++m_Complete;
    }
  }
}

void
TiffWriter::Commit()
{
  if (m_Complete != m_Slices)
  {
    this->Fail("it has " + std::to_string(m_Complete) + " of " + std::to_string(m_Slices) + " slices");
  }
  m_Pages.reset();
  const auto             written = OpenTiff(m_Folder->GetFileName().string(), {}, [](const std::string &) {});
  const ImageDescription found = written->GetDescription();
  if (found.Grid.Size != m_Description.Grid.Size && m_Slices > 1)
  {
    this->Fail("not all slices were written");
  }
  m_Folder->Commit();
  m_Folder.reset();
}
} // namespace

std::unique_ptr<VolumeWriter>
CreateTiff(const std::string & path, const OutputOptions & options, const WarningSink & warn)
{
  return std::make_unique<TiffWriter>(path, options, warn);
}
