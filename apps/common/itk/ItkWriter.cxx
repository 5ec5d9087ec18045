// SPDX-License-Identifier: Apache-2.0
#include "itk/ItkWriter.h"
#include "deflate/ParallelDeflate.h"
#include "headers/Metadata.h"
#include "itk/FormatLimits.h"
#include "itk/ItkReader.h"
#include "itk/LibraryReason.h"
#include "itk/PixelComponent.h"
#include "itk/WrittenImage.h"
#include "nifti/NiftiFiles.h"
#include "nifti/ReplacedPair.h"
#include "system/files/CurrentFolder.h"
#include "system/files/InputFile.h"
#include "system/files/OutputFile.h"
#include "system/process/WatchedTask.h"
#include "text/HeaderText.h"

#include "itkImageFileReader.h" // registers the formats
#include "itkMetaDataObject.h"

#include <algorithm>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{
[[noreturn]] void
Fail(const std::string & path, const std::string & reason)
{
  throw std::runtime_error("cannot write " + path + ": " + reason);
}

itk::IOPixelEnum
GetPixelType(VoxelKind kind)
{
  switch (kind)
  {
    case VoxelKind::Scalar:
      return itk::IOPixelEnum::SCALAR;
    case VoxelKind::Rgb:
      return itk::IOPixelEnum::RGB;
    case VoxelKind::Rgba:
      return itk::IOPixelEnum::RGBA;
    case VoxelKind::Complex:
      return itk::IOPixelEnum::COMPLEX;
    case VoxelKind::SymmetricTensor:
      return itk::IOPixelEnum::SYMMETRICSECONDRANKTENSOR;
    case VoxelKind::Vector:
      break;
  }
  return itk::IOPixelEnum::VECTOR;
}

/** Small whole numbers in a row, in the type of the voxels. */
std::vector<char>
MakeTestVoxels(const ImageDescription & description)
{
  const std::uint64_t count = description.GetNumberOfVoxels() * description.NumberOfComponents;
  std::vector<char>   bytes(count * itk::Subdivision::SizeOf(description.Component));
  itk::Subdivision::WithElementType(description.Component, [&](auto tag) {
    using Type = typename decltype(tag)::Type;
    Type * const values = reinterpret_cast<Type *>(bytes.data());
    for (std::uint64_t i = 0; i < count; ++i)
    {
      values[i] = static_cast<Type>(i % 101);
    }
  });
  return bytes;
}

itk::IOComponentEnum
GetComponentType(itk::Subdivision::ElementType type)
{
  return itk::Subdivision::WithElementType(type,
                                           [](auto tag) { return PixelComponentOf<typename decltype(tag)::Type>; });
}

std::string
Join(const std::vector<std::string> & words)
{
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  }
  return text;
}
/** ITK's writers know endings in small letters. */
std::string
WithEndingInSmallLetters(const fs::path & name)
{
  const fs::path    stem = name.stem();
  const std::string ending = ToLower(name.extension().string());
  return ending == ".gz" ? stem.stem().string() + ToLower(stem.extension().string()) + ending : stem.string() + ending;
}

std::string
WithEndingInCapitals(const fs::path & name)
{
  const fs::path    stem = name.extension() == ".gz" ? name.stem().stem() : name.stem();
  const std::size_t start = stem.string().size();
  std::string       text = name.string();
  for (std::size_t i = start; i < text.size(); ++i)
  {
    text[i] = text[i] >= 'a' && text[i] <= 'z' ? static_cast<char>(text[i] - 'a' + 'A') : text[i];
  }
  return text;
}

struct NotHeld : std::runtime_error
{
  NotHeld()
    : std::runtime_error("its format cannot hold such voxels")
  {}
};

/** What a small file that was just written holds: one that cannot be read is none of its format. */
ImageDescription
DescribeWritten(const std::string & file)
{
  try
  {
    return ItkReader(file).GetDescription();
  }
  catch (const std::runtime_error &)
  {
    throw NotHeld();
  }
}
} // namespace

ItkWriter::ItkWriter(const std::string & path, const OutputOptions & options, const WarningSink & warn)
  : m_Path(path)
  , m_Options(options)
  , m_Warn(warn)
{
  const std::string name = ToLower(fs::path(path).filename().string());
  const std::string ending = ".nii.gz";
  m_IsGzipped = name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

std::vector<fs::path>
ItkWriter::GetReplacedFiles() const
{
  const std::string output = ResolveOutput(m_Path).string();
  return IsNiftiPair(output) ? ListWrittenPair(output) : std::vector<fs::path>{ output };
}

bool
ItkWriter::WritesParts() const
{
  return false;
}

std::uint64_t
ItkWriter::GetScratchBytes(std::uint64_t partBytes) const
{
  return 2 * partBytes; // a copy, and one of what is read back
}

itk::ImageIOBase::Pointer
ItkWriter::MakeImageIO(const ImageDescription & description) const
{
  const ImageIOPointer imageIO =
    itk::ImageIOFactory::CreateImageIO(m_File.string().c_str(), itk::IOFileModeEnum::WriteMode);
  if (imageIO.IsNull())
  {
    Fail(m_Path, "no known image format has the ending '" + fs::path(m_Path).extension().string() + "'");
  }
  imageIO->SetUseCompression(m_Options.Compress && !m_IsGzipped);
  if (m_Options.Compress && m_Options.CompressionLevel > 0)
  {
    imageIO->SetCompressionLevel(m_Options.CompressionLevel);
  }
  const ImageGrid &  grid = description.Grid;
  itk::ImageIORegion region(static_cast<unsigned int>(grid.Size.size()));
  imageIO->SetNumberOfDimensions(static_cast<unsigned int>(grid.Size.size()));
  for (unsigned int axis = 0; axis < grid.Size.size(); ++axis)
  {
    imageIO->SetDimensions(axis, grid.Size[axis]);
    imageIO->SetSpacing(axis, grid.Spacing[axis]);
    imageIO->SetOrigin(axis, grid.Origin[axis]);
    imageIO->SetDirection(axis, grid.Directions[axis]);
    region.SetSize(axis, grid.Size[axis]);
  }
  imageIO->SetIORegion(region);
  imageIO->SetComponentType(GetComponentType(description.Component));
  imageIO->SetNumberOfComponents(description.NumberOfComponents);
  imageIO->SetPixelType(GetPixelType(description.Kind));
  itk::MetaDataDictionary dictionary;
  for (const auto & [key, value] : SelectMetadata(description, MetadataStyle::Other, m_Options.KeepMetadata).Keys)
  {
    itk::EncapsulateMetaData<std::string>(dictionary, key, value);
  }
  imageIO->SetMetaDataDictionary(dictionary);
  imageIO->SetFileName(m_File.string());
  return imageIO;
}

void
ItkWriter::WriteFile(const ImageDescription & description, const void * voxels) const
{
  const WatchedTask   task("cannot write " + m_Path);
  const CurrentFolder folder(m_File.parent_path());
  // Some formats are written to the end only when their writer is gone.
  this->MakeImageIO(description)->Write(voxels);
}

void
ItkWriter::Try()
{
  ImageDescription small = m_Description;
  for (std::uint64_t & size : small.Grid.Size)
  {
    size = std::min<std::uint64_t>(size, 32);
  }
  const std::vector<char> voxels = MakeTestVoxels(small);
  const std::string       what = "an image with " + std::to_string(small.Grid.Size.size()) + " axes and voxels of " +
                           std::to_string(small.NumberOfComponents) + " x " + GetName(small.Component);
  std::vector<std::string> losses;
  try
  {
    this->WriteFile(small, voxels.data());
    this->CheckPartners();
    const ImageDescription written = DescribeWritten(m_File.string());
    if (!HaveSameVoxels(small, written))
    {
      throw NotHeld();
    }
    losses = FindLosses(small, written);
    // JPEG may keep the few of a small image.
    const bool isJpeg = std::string(this->MakeImageIO(small)->GetNameOfClass()) == "JPEGImageIO";
    m_IsLossless = !isJpeg && HasRows(m_File.string(), small, voxels.data());
  }
  catch (const std::exception & error)
  {
    Fail(m_Path, what + " cannot be written there: " + GetReason(error));
  }
  m_Folder->Clear();
  const std::string unit = GetUnit(m_Description);
  if (!unit.empty() && unit != "mm")
  {
    losses.push_back("the unit " + unit);
  }
  if (!losses.empty())
  {
    m_Warn("the format of " + m_Path + " cannot hold " + Join(losses) + " of the image");
  }
  if (!m_IsLossless)
  {
    m_Warn("the format of " + m_Path + " changes the values of voxels");
  }
}

void
ItkWriter::Begin(const ImageDescription & description)
{
  if (HasNiftiEndingInMixedCase(m_Path))
  {
    Fail(m_Path, "NIfTI files' endings are in small letters or in capitals, not in both");
  }
  if (IsNiftiPair(m_Path))
  {
    WarnOfLinkToPair(m_Path, m_Warn);
  }
  m_Description = description;
  m_Folder = std::make_unique<TemporaryFolder>(m_Path, m_Warn);
  const fs::path output = m_Folder->GetFileName();
  m_File = output.parent_path() / (m_IsGzipped ? "image.nii" : WithEndingInSmallLetters(output.filename()));
  const ImageIOPointer imageIO = this->MakeImageIO(description);
  CheckFormatLimits(m_Path, description, *imageIO);
  this->Try();
}

/** What each file that ITK wrote is to be called. The files of a pair have endings of one case. */
std::map<fs::path, fs::path>
ItkWriter::GetFinalNames() const
{
  const fs::path               output = m_Folder->GetFileName().filename();
  const bool                   isInCapitals = output.string() == WithEndingInCapitals(m_File.filename());
  std::map<fs::path, fs::path> names;
  for (const fs::directory_entry & entry : fs::directory_iterator(m_File.parent_path()))
  {
    const fs::path name = entry.path().filename();
    names[name] = name == m_File.filename() ? output : isInCapitals ? fs::path(WithEndingInCapitals(name)) : name;
  }
  return names;
}

/** Where the output replaces an image of two files, it replaces both; no other file gives way. */
void
ItkWriter::CheckPartners() const
{
  const fs::path output = m_Folder->GetOutput();
  for (const fs::path & other : ListOtherPair(output.string()))
  {
    if (fs::exists(fs::symlink_status(other)))
    {
      throw std::runtime_error("beside it, it could not be told which of both is meant: " + other.string() +
                               "; move that away");
    }
  }
  if (m_IsGzipped)
  {
    return;
  }
  if (fs::exists(output))
  {
    CheckReplacedPair(output.string());
    return;
  }
  for (const auto & names : this->GetFinalNames())
  {
    const fs::path partner = output.parent_path() / names.second;
    if (fs::exists(fs::symlink_status(partner)))
    {
      throw std::runtime_error("it would replace the file " + partner.string());
    }
  }
}

void
ItkWriter::Write(const itk::Subdivision::Box &, const void * voxels)
{
  try
  {
    this->WriteFile(m_Description, voxels);
    m_Folder->CheckThatAllWasWritten();
    const ItkReader reader(m_File.string());
    if (!HaveSameVoxels(m_Description, reader.GetDescription()))
    {
      throw std::runtime_error("only a part of the image was written");
    }
    if (m_IsLossless && !HasRows(m_File.string(), m_Description, voxels))
    {
      throw std::runtime_error("not all voxels were written");
    }
  }
  catch (const std::exception & error)
  {
    Fail(m_Path, GetReason(error));
  }
}

void
ItkWriter::Compress()
{
  const std::string file = m_Folder->GetFileName().string();
  const InputFile   input(m_File.string());
  OutputFile        output(file, m_Path);
  std::uint64_t     place = 0;
  ParallelDeflate   deflate(ParallelDeflate::Wrapper::Gzip,
                          m_Options.CompressionLevel,
                          m_Options.Threads,
                          [&](const void * bytes, std::size_t count) {
                            output.WriteAt(place, bytes, count);
                            place += count;
                          });
  std::vector<char> part(1 << 22);
  for (std::uint64_t done = 0; done < input.GetSize();)
  {
    const auto count = std::min<std::uint64_t>(part.size(), input.GetSize() - done);
    input.ReadAt(done, part.data(), count);
    deflate.Write(part.data(), count);
    done += count;
  }
  deflate.Finish();
}

void
ItkWriter::Commit()
{
  const fs::path output = m_Folder->GetFileName();
  if (m_IsGzipped)
  {
    this->Compress();
    fs::remove(m_File);
  }
  const bool replaces = fs::exists(m_Folder->GetOutput());
  for (const auto & [name, finalName] : m_IsGzipped ? std::map<fs::path, fs::path>() : this->GetFinalNames())
  {
    if (name != finalName)
    {
      fs::rename(output.parent_path() / name, output.parent_path() / finalName);
    }
    if (replaces)
    {
      m_Folder->AllowReplacing(finalName.string());
    }
  }
  m_Folder->Commit();
}
