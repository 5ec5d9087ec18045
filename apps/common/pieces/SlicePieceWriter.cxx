// SPDX-License-Identifier: Apache-2.0
#include "pieces/PieceWriter.h"
#include "slices/SliceFolderWriter.h"
#include "system/files/DiskRoom.h"
#include "system/files/DiskSync.h"
#include "tiff/TiffPageWriter.h"

#include <stdexcept>

namespace fs = std::filesystem;
using itk::Subdivision::Box;

namespace
{
/** Each slice gets its name when it is complete. */
class SlicePieceWriter : public PieceWriter
{
public:
  SlicePieceWriter(const std::string & path, const OutputOptions & options, WarningSink warn)
    : m_Path(path)
    , m_Output(fs::weakly_canonical(GetSliceFolder(path)))
    , m_Options(options)
    , m_Warn(std::move(warn))
  {}

  std::vector<fs::path>
  GetReplacedFiles() const override
  {
    return { m_Output };
  }

  bool
  WritesParts() const override
  {
    return true;
  }

  std::uint64_t
  GetScratchBytes(std::uint64_t) const override
  {
    return std::uint64_t{ 1 } << 20; // a strip
  }

  const fs::path &
  GetOutput() const override
  {
    return m_Output;
  }

  bool
  SplitsPlanes() const override
  {
    return false;
  }

  void
  Begin(const ImageDescription & description) override
  {
    CheckForTiff(m_Path, description, m_Warn);
    m_Description = description;
    m_Slices = description.Grid.Size.size() > 2 ? description.Grid.Size[2] : 1;
    CheckOldSlices(m_Path, m_Output);
  }

  void
  LayOut(const fs::path & folder) const override
  {
    CheckFreeBytes(m_Path, folder, m_Description.GetBytes());
    fs::create_directory(folder / m_Output.filename());
  }

  void
  Open(const fs::path & folder, const fs::path & temporary, const Piece &) override
  {
    m_Folder = folder / m_Output.filename();
    m_Temporary = temporary;
  }

  void
  Write(const Box & box, const void * voxels) override
  {
    const std::uint64_t first = box.size() > 2 ? static_cast<std::uint64_t>(box[2].First) : 0;
    const std::uint64_t count = box.size() > 2 ? box[2].Size : 1;
    const std::uint64_t bytes = box[1].Size * box[0].Size * m_Description.GetVoxelBytes();
    for (std::uint64_t i = 0; i < count; ++i)
    {
      this->WriteRows(first + i, box[1].Size, static_cast<const char *>(voxels) + i * bytes);
    }
  }

  void
  Commit() override
  {
    if (m_Slice != nullptr)
    {
      this->Fail("its last slice lacks rows");
    }
    if (const std::error_code error = BringToDisk(m_Folder))
    {
      this->Fail(error.message());
    }
  }

  std::uint32_t
  ReadChecksum(const fs::path & folder, const Piece & piece) const override
  {
    std::uint32_t checksum = 0;
    for (const Box & box : piece)
    {
      const std::uint64_t first = box.size() > 2 ? static_cast<std::uint64_t>(box[2].First) : 0;
      const std::uint64_t count = box.size() > 2 ? box[2].Size : 1;
      for (std::uint64_t slice = first; slice < first + count; ++slice)
      {
        const fs::path file = folder / m_Output.filename() / GetSliceName(m_Output, slice, m_Slices);
        checksum = AddToChecksum(checksum, file, 0, fs::file_size(file));
      }
    }
    return checksum;
  }

  void
  CheckAll(const fs::path & folder) const override
  {
    for (std::uint64_t slice = 0; slice < m_Slices; ++slice)
    {
      const std::string name = GetSliceName(m_Output, slice, m_Slices);
      if (!IsOwnTiff((folder / m_Output.filename() / name).string()))
      {
        this->Fail(name + " is missing or not whole");
      }
    }
    CheckOldSlices(m_Path, m_Output); // other programs may have written there meanwhile
    KeepFilesOfSystems(m_Path, m_Output, folder / m_Output.filename());
  }

  std::optional<DetachedPair>
  FindPair(const fs::path &) const override
  {
    return std::nullopt;
  }

  std::optional<fs::path>
  FindOldData() const override
  {
    return std::nullopt;
  }

private:
  [[noreturn]] void
  Fail(const std::string & reason) const
  {
    throw std::runtime_error("cannot write " + m_Path + ": " + reason);
  }

  void
  WriteRows(const std::uint64_t slice, const std::uint64_t rows, const void * voxels)
  {
    const std::string name = GetSliceName(m_Output, slice, m_Slices);
    const fs::path    unnamed = m_Temporary / name;
    if (m_Slice == nullptr)
    {
      m_Slice = std::make_unique<TiffPageWriter>(
        unnamed.string(), (m_Output / name).string(), m_Description, m_Options, NeedsBigTiff(m_Description));
      m_Slice->BeginPage(MakeImageJText(m_Description, 1));
    }
    m_Slice->WriteRows(voxels, rows);
    m_Rows += rows;
    if (m_Rows < m_Description.Grid.Size[1])
    {
      return;
    }
    m_Slice->EndPage();
    m_Slice.reset();
    m_Rows = 0;
    if (const std::error_code error = BringToDiskAs(unnamed, m_Folder / name))
    {
      this->Fail(error.message());
    }
  }

  std::string                     m_Path;
  fs::path                        m_Output;
  OutputOptions                   m_Options;
  WarningSink                     m_Warn;
  ImageDescription                m_Description;
  std::uint64_t                   m_Slices = 1;
  fs::path                        m_Folder;
  fs::path                        m_Temporary;
  std::unique_ptr<TiffPageWriter> m_Slice; // that lacks rows yet
  std::uint64_t                   m_Rows = 0;
};
} // namespace

std::unique_ptr<PieceWriter>
CreateSlicePieceWriter(const std::string & path, const OutputOptions & options, const WarningSink & warn)
{
  return std::make_unique<SlicePieceWriter>(path, options, warn);
}
