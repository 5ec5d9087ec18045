// SPDX-License-Identifier: Apache-2.0
#include "slices/SliceFolderWriter.h"
#include "outputs/StagedFolder.h"
#include "system/files/DiskRoom.h"
#include "text/HeaderText.h"
#include "tiff/TiffPageWriter.h"

#include "NonOscillatorySubdivision/RunTiles.h"

#include <algorithm>
#include <stdexcept>

namespace fs = std::filesystem;
using itk::Subdivision::Box;

namespace
{
bool
HasNameOfSlice(const fs::path & folder, const std::string & name)
{
  const std::string start = folder.filename().string() + '_';
  const std::string end = ".tif";
  const auto        digits = [&] { return name.substr(start.size(), name.size() - start.size() - end.size()); };
  return name.size() > start.size() + end.size() && name.compare(0, start.size(), start) == 0 &&
         name.compare(name.size() - end.size(), end.size(), end) == 0 &&
         digits().find_first_not_of("0123456789") == std::string::npos;
}

/** Whether macOS or Windows made a file to show the folder, or to keep what belongs to another file. */
bool
IsOfSystem(const fs::directory_entry & entry)
{
  const std::string name = ToLower(entry.path().filename().string());
  std::error_code   error;
  return fs::is_regular_file(entry.symlink_status(error)) &&
         (name == ".ds_store" || name == "thumbs.db" || name == "desktop.ini" || name.rfind("._", 0) == 0);
}

class SliceFolderWriter : public VolumeWriter
{
public:
  SliceFolderWriter(const std::string & path, const OutputOptions & options, WarningSink warn)
    : m_Path(path)
    , m_Output(GetSliceFolder(path))
    , m_Stem(m_Output.filename().string())
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
    // Of each slice that is being written: a strip, as it is and compressed, and a row.
    return std::max(m_Options.Threads, 1u) * (std::uint64_t{ 1 } << 20);
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

  std::unique_ptr<TiffPageWriter>
  OpenSlice(std::uint64_t number) const;
  void
  WriteWholeSlices(std::uint64_t first, std::uint64_t count, const unsigned char * voxels) const;
  void
  WriteRows(std::uint64_t slice, std::uint64_t rows, const unsigned char * voxels);

  std::string                     m_Path;
  fs::path                        m_Output;
  std::string                     m_Stem;
  OutputOptions                   m_Options;
  WarningSink                     m_Warn;
  ImageDescription                m_Description;
  std::uint64_t                   m_Slices = 1;
  std::uint64_t                   m_Complete = 0; // slices
  std::unique_ptr<StagedFolder>   m_Folder;
  std::unique_ptr<TiffPageWriter> m_Slice; // that lacks rows yet
  std::uint64_t                   m_Rows = 0;
};

/** Writes slices as the tiles of a run. */
class SliceRun
{
public:
  SliceRun(std::size_t slices, std::function<void(std::size_t)> write)
    : m_Slices(slices)
    , m_Write(std::move(write))
  {}

  std::size_t
  GetNumberOfTiles() const
  {
    return m_Slices;
  }

  void
  ComputeTile(std::size_t number, const SliceRun &) const
  {
    m_Write(number);
  }

private:
  std::size_t                      m_Slices;
  std::function<void(std::size_t)> m_Write;
};

void
SliceFolderWriter::Begin(const ImageDescription & description)
{
  CheckForTiff(m_Path, description, m_Warn);
  m_Description = description;
  m_Slices = description.Grid.Size.size() > 2 ? description.Grid.Size[2] : 1;
  if (m_Stem.empty())
  {
    this->Fail("the folder needs a name");
  }
  CheckOldSlices(m_Path, m_Output);
  m_Folder = std::make_unique<StagedFolder>(m_Output);
  if (!m_Options.Compress)
  {
    CheckFreeBytes(m_Path, m_Folder->GetPath(), m_Description.GetBytes());
  }
}

std::unique_ptr<TiffPageWriter>
SliceFolderWriter::OpenSlice(std::uint64_t number) const
{
  const std::string name = GetSliceName(m_Output, number, m_Slices);
  auto              slice = std::make_unique<TiffPageWriter>((m_Folder->GetPath() / name).string(),
                                                (m_Output / name).string(),
                                                m_Description,
                                                m_Options,
                                                NeedsBigTiff(m_Description));
  slice->BeginPage(MakeImageJText(m_Description, 1));
  return slice;
}

void
SliceFolderWriter::Write(const Box & box, const void * voxels)
{
  const std::uint64_t first = box.size() > 2 ? static_cast<std::uint64_t>(box[2].First) : 0;
  const std::uint64_t count = box.size() > 2 ? box[2].Size : 1;
  const auto *        bytes = static_cast<const unsigned char *>(voxels);
  const bool          isNext = first == m_Complete && static_cast<std::uint64_t>(box[1].First) == m_Rows;
  const bool          isWhole = box[1].Size == m_Description.Grid.Size[1];
  if (!isNext || box[0].Size != m_Description.Grid.Size[0] || (count > 1 && !isWhole))
  {
    this->Fail("its parts do not continue each other");
  }
  if (isWhole)
  {
    this->WriteWholeSlices(first, count, bytes);
    m_Complete += count;
  }
  else
  {
    this->WriteRows(first, box[1].Size, bytes);
  }
}

void
SliceFolderWriter::WriteWholeSlices(std::uint64_t first, std::uint64_t count, const unsigned char * voxels) const
{
  const std::uint64_t rows = m_Description.Grid.Size[1];
  const std::uint64_t sliceBytes = rows * m_Description.Grid.Size[0] * m_Description.GetVoxelBytes();
  SliceRun            run(count, [&](std::size_t number) {
    const auto slice = this->OpenSlice(first + number);
    slice->WriteRows(voxels + number * sliceBytes, rows);
    slice->EndPage();
  });
  itk::Subdivision::RunTiles(run, m_Options.Compress ? m_Options.Threads : 1, run);
}

void
SliceFolderWriter::WriteRows(std::uint64_t slice, std::uint64_t rows, const unsigned char * voxels)
{
  if (!m_Slice)
  {
    m_Slice = this->OpenSlice(slice);
  }
  m_Slice->WriteRows(voxels, rows);
  m_Rows += rows;
  if (m_Rows == m_Description.Grid.Size[1])
  {
    m_Slice->EndPage();
    m_Slice.reset();
    m_Rows = 0;
    ++m_Complete;
  }
}

void
SliceFolderWriter::Commit()
{
  if (m_Complete != m_Slices)
  {
    this->Fail("it has " + std::to_string(m_Complete) + " of " + std::to_string(m_Slices) + " slices");
  }
  CheckOldSlices(m_Path, m_Output); // other programs may have written there meanwhile
  KeepFilesOfSystems(m_Path, m_Output, m_Folder->GetPath());
  m_Folder->Commit();
  m_Folder.reset();
}
} // namespace

fs::path
GetSliceFolder(const std::string & path)
{
  const fs::path full = fs::absolute(path).lexically_normal();
  return full.has_filename() ? full : full.parent_path();
}

std::string
GetSliceName(const fs::path & folder, const std::uint64_t number, const std::uint64_t slices)
{
  const std::string digits = std::to_string(number);
  const std::size_t width = std::max<std::size_t>(4, std::to_string(slices - 1).size());
  return folder.filename().string() + '_' + std::string(width - digits.size(), '0') + digits + ".tif";
}

bool
NeedsBigTiff(const ImageDescription & description)
{
  return description.Grid.Size[0] * description.Grid.Size[1] * description.GetVoxelBytes() > 4000000000u;
}

void
KeepFilesOfSystems(const std::string & path, const fs::path & from, const fs::path & to)
{
  std::error_code error;
  if (!fs::is_directory(from, error))
  {
    return;
  }
  for (const fs::directory_entry & entry : fs::directory_iterator(from))
  {
    if (IsOfSystem(entry) &&
        !fs::copy_file(entry.path(), to / entry.path().filename(), fs::copy_options::overwrite_existing, error))
    {
      throw std::runtime_error("cannot write " + path + ": " + entry.path().filename().string() +
                               " cannot be kept: " + error.message());
    }
  }
}

void
CheckOldSlices(const std::string & path, const fs::path & folder)
{
  const auto fail = [&path](const std::string & reason) {
    throw std::runtime_error("cannot write " + path + ": " + reason);
  };
  std::error_code error;
  if (!fs::exists(folder, error))
  {
    return;
  }
  if (!fs::is_directory(folder, error))
  {
    fail("a file has that name");
  }
  for (const fs::directory_entry & entry : fs::directory_iterator(folder))
  {
    const std::string name = entry.path().filename().string();
    if (IsOfSystem(entry))
    {
      continue;
    }
    if (!HasNameOfSlice(folder, name) || !fs::is_regular_file(entry.symlink_status(error)) ||
        !IsOwnTiff(entry.path().string()))
    {
      fail("the folder holds " + name + ", which is no slice of an earlier output; name another folder");
    }
  }
}

std::unique_ptr<VolumeWriter>
CreateSliceFolder(const std::string & path, const OutputOptions & options, const WarningSink & warn)
{
  return std::make_unique<SliceFolderWriter>(path, options, warn);
}
