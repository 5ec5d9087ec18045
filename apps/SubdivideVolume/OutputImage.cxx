// SPDX-License-Identifier: Apache-2.0
#include "OutputImage.h"
#include "FileIntegrity.h"

#include "itkImageIOFactory.h"
#include "itkMetaImageIO.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <functional>
#include <numeric>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{
/** What an exception says, less the place in the code that ITK's exceptions name. */
std::string
GetReason(const std::exception & error)
{
  const auto * const itkError = dynamic_cast<const itk::ExceptionObject *>(&error);
  return itkError != nullptr ? itkError->GetDescription() : error.what();
}

std::string
InMegabytes(std::uint64_t bytes)
{
  return std::to_string(bytes / 1000000) + " MB";
}

/** Says so at once if the disk has not enough room. */
void
CheckDiskSpace(const std::string & path, const fs::path & folder, std::uint64_t bytes)
{
  std::error_code error;
  const auto      space = fs::space(folder, error);
  if (!error && space.available < bytes)
  {
    throw std::runtime_error("cannot write " + path + ": it needs " + InMegabytes(bytes) + ", and the disk has " +
                             InMegabytes(space.available) + " left");
  }
}

/** Reserves the blocks of a file that has its full size already, so that the disk cannot run full later. */
void
ReserveBlocks([[maybe_unused]] const fs::path & path)
{
#ifdef __linux__
  const int descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0)
  {
    return;
  }
  const int result = fallocate(descriptor, 0, 0, static_cast<off_t>(fs::file_size(path)));
  const int error = errno;
  close(descriptor);
  if (result != 0 && (error == ENOSPC || error == EDQUOT || error == EFBIG))
  {
    throw std::runtime_error(std::strerror(error));
  }
#endif
}

bool
IsMetaImage(const itk::ImageIOBase * imageIO)
{
  return dynamic_cast<const itk::MetaImageIO *>(imageIO) != nullptr;
}

std::uint64_t
GetNumberOfVoxels(const std::vector<itk::SizeValueType> & size)
{
  return std::accumulate(size.begin(), size.end(), std::uint64_t{ 1 }, std::multiplies<>());
}

itk::ImageIORegion
GetWholeRegion(const ImageGrid & grid)
{
  itk::ImageIORegion region(static_cast<unsigned int>(grid.Size.size()));
  region.SetSize(grid.Size);
  return region;
}

void
Describe(itk::ImageIOBase & imageIO, const ImageGrid & grid, PixelComponent component, const InputImage & input)
{
  imageIO.SetNumberOfDimensions(static_cast<unsigned int>(grid.Size.size()));
  for (unsigned int axis = 0; axis < grid.Size.size(); ++axis)
  {
    imageIO.SetDimensions(axis, grid.Size[axis]);
    imageIO.SetSpacing(axis, grid.Spacing[axis]);
    imageIO.SetOrigin(axis, grid.Origin[axis]);
    imageIO.SetDirection(axis, grid.Directions[axis]);
  }
  imageIO.SetComponentType(component);
  imageIO.SetNumberOfComponents(input.NumberOfComponents);
  imageIO.SetPixelType(input.ImageIO->GetPixelType());

  itk::MetaDataDictionary dictionary = input.ImageIO->GetMetaDataDictionary();
  // What itk::ImageFileReader notes of the input's grid is wrong for the output.
  dictionary.Erase("ITK_original_spacing");
  dictionary.Erase("ITK_original_direction");
  imageIO.SetMetaDataDictionary(dictionary);
}

/** Makes a folder the current one as long as this lives. MetaIO looks for a data file's name in the current folder before
 * it looks beside the header: any other folder could hold somebody else's file of that name, which would be written. */
class CurrentFolder
{
public:
  explicit CurrentFolder(const fs::path & folder)
    : m_Before(fs::current_path())
  {
    fs::current_path(folder);
  }
  ~CurrentFolder()
  {
    std::error_code error;
    fs::current_path(m_Before, error);
  }
  CurrentFolder(const CurrentFolder &) = delete;
  CurrentFolder &
  operator=(const CurrentFolder &) = delete;

private:
  fs::path m_Before;
};

/** A reader for what was written, its header read and compared with what was to be written. */
itk::ImageIOBase::Pointer
OpenWrittenFile(const std::string & file, itk::ImageIOBase::SizeType numberOfVoxels)
{
  const auto reader = itk::ImageIOFactory::CreateImageIO(file.c_str(), itk::IOFileModeEnum::ReadMode);
  if (reader.IsNull())
  {
    throw std::runtime_error("what was written cannot be read back");
  }
  reader->SetFileName(file);
  reader->ReadImageInformation();
  if (reader->GetImageSizeInPixels() != numberOfVoxels)
  {
    throw std::runtime_error("only a part of the image was written");
  }
  CheckFileIsWhole(file, *reader);
  return reader;
}

/** Whether the values in a file are these. */
bool
HasValues(itk::ImageIOBase & reader, PixelComponent component, const void * values, itk::ImageIOBase::SizeType bytes)
{
  if (reader.GetComponentType() != component || reader.GetImageSizeInBytes() != bytes)
  {
    return false;
  }
  itk::ImageIORegion region(reader.GetNumberOfDimensions());
  for (unsigned int axis = 0; axis < reader.GetNumberOfDimensions(); ++axis)
  {
    region.SetSize(axis, reader.GetDimensions(axis));
  }
  std::vector<char> back(static_cast<std::size_t>(bytes));
  reader.SetIORegion(region);
  reader.Read(back.data());
  return std::memcmp(back.data(), values, back.size()) == 0;
}

/** Small whole numbers in a row, in the type of the file. */
std::vector<char>
MakeTestValues(std::size_t count, PixelComponent component)
{
  std::vector<float> numbers(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    numbers[i] = static_cast<float>(i % 101);
  }
  std::vector<char> values(count * GetPixelComponentSize(component));
  ConvertReals(numbers.data(), count, component, values.data());
  return values;
}
} // namespace

OutputImage::OutputImage(const std::string & path, bool compress)
  : m_Path(path)
  , m_Compress(compress)
  , m_ImageIO(this->MakeImageIO())
{}

itk::ImageIOBase::Pointer
OutputImage::MakeImageIO() const
{
  const auto imageIO = itk::ImageIOFactory::CreateImageIO(m_Path.c_str(), itk::IOFileModeEnum::WriteMode);
  if (imageIO.IsNull())
  {
    throw std::runtime_error("cannot write " + m_Path + ": no known image format has the ending '" +
                             fs::path(m_Path).extension().string() + "'");
  }
  imageIO->SetUseCompression(m_Compress);
  return imageIO;
}

bool
OutputImage::CanStream() const
{
  return IsMetaImage(m_ImageIO) && m_ImageIO->CanStreamWrite();
}

std::uint64_t
OutputImage::GetWriterBytes(std::uint64_t imageBytes) const
{
  // MetaIO writes from where the values are; it compresses the whole image in memory, and the others may copy it.
  return this->CanStream() ? 0 : 2 * imageBytes;
}

bool
OutputImage::Try(const ImageGrid & grid, PixelComponent component, const InputImage & input) const
{
  ImageGrid small = grid;
  for (itk::SizeValueType & size : small.Size)
  {
    size = std::min<itk::SizeValueType>(size, 32);
  }
  const std::vector<char> values = MakeTestValues(GetNumberOfVoxels(small.Size) * input.NumberOfComponents, component);
  const std::string       file = m_Folder->GetFileName().string();
  bool                    isLossless = false;
  const CurrentFolder     folder(m_Folder->GetFileName().parent_path());
  try
  {
    ImageIOPointer imageIO = this->MakeImageIO();
    Describe(*imageIO, small, component, input);
    imageIO->SetFileName(file);
    imageIO->SetIORegion(GetWholeRegion(small));
    imageIO->Write(values.data());
    imageIO = nullptr; // some write the rest only now
    isLossless =
      HasValues(*OpenWrittenFile(file, GetNumberOfVoxels(small.Size)), component, values.data(), values.size());
  }
  catch (const std::exception & error)
  {
    throw std::runtime_error("cannot write " + m_Path + ", an image with " + std::to_string(grid.Size.size()) +
                             " axes and voxels of " + std::to_string(input.NumberOfComponents) + " x " +
                             GetPixelComponentName(component) + ": " + GetReason(error));
  }
  m_Folder->Clear();
  return isLossless;
}

void
OutputImage::Begin(const ImageGrid & grid, PixelComponent component, const InputImage & input)
{
  m_Folder = std::make_unique<TemporaryFolder>(m_Path);
  if (this->CanStream())
  {
    CheckDiskSpace(m_Path,
                   m_Folder->GetFileName().parent_path(),
                   GetNumberOfVoxels(grid.Size) * input.NumberOfComponents * GetPixelComponentSize(component));
  }
  m_IsLossless = this->Try(grid, component, input);
  Describe(*m_ImageIO, grid, component, input);
  m_ImageIO->SetFileName(m_Folder->GetFileName().string());
  m_ImageIO->SetUseStreamedWriting(this->CanStream());
}

void
OutputImage::Write(const itk::ImageIORegion & region, const void * values)
{
  const fs::path file = m_Folder->GetFileName();
  const bool     isFirst = !fs::exists(file);
  m_ImageIO->SetIORegion(region);
  const CurrentFolder folder(file.parent_path());
  try
  {
    m_ImageIO->Write(values);
    if (isFirst)
    {
      for (const auto & entry : fs::directory_iterator(file.parent_path()))
      {
        ReserveBlocks(entry.path());
      }
    }
    if (!this->CanStream())
    {
      this->Verify(values);
    }
  }
  catch (const std::exception & error)
  {
    throw std::runtime_error("cannot write " + m_Path + ": " + GetReason(error));
  }
}

void
OutputImage::Verify(const void * values)
{
  const auto           numberOfVoxels = m_ImageIO->GetImageSizeInPixels();
  const auto           bytes = m_ImageIO->GetImageSizeInBytes();
  const PixelComponent component = m_ImageIO->GetComponentType();
  m_ImageIO = this->MakeImageIO(); // some write the rest only when they are gone
  m_Folder->CheckThatAllWasWritten();
  const ImageIOPointer reader = OpenWrittenFile(m_Folder->GetFileName().string(), numberOfVoxels);
  if (m_IsLossless && !HasValues(*reader, component, values, bytes))
  {
    throw std::runtime_error("not all voxels were written");
  }
}

void
OutputImage::Commit()
{
  if (this->CanStream())
  {
    const CurrentFolder folder(m_Folder->GetFileName().parent_path());
    try
    {
      m_Folder->CheckThatAllWasWritten();
      OpenWrittenFile(m_Folder->GetFileName().string(), m_ImageIO->GetImageSizeInPixels());
    }
    catch (const std::exception & error)
    {
      throw std::runtime_error("cannot write " + m_Path + ": " + GetReason(error));
    }
  }
  m_Folder->Commit();
}
