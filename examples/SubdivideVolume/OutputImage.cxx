// SPDX-License-Identifier: Apache-2.0
#include "OutputImage.h"
#include "FileIntegrity.h"

#include "itkImageIOFactory.h"
#include "itkMetaImageIO.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{
std::string
InMegabytes(std::uint64_t bytes)
{
  return std::to_string(bytes / 1000000) + " MB";
}

/** Says so at once if the disk has not enough room. */
void
CheckDiskSpace(const fs::path & folder, std::uint64_t bytes)
{
  std::error_code error;
  const auto      space = fs::space(folder, error);
  if (!error && space.available < bytes)
  {
    throw std::runtime_error("the output needs " + InMegabytes(bytes) + ", and the disk has " +
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
} // namespace

OutputImage::OutputImage(const std::string & path, bool compress)
  : m_Path(path)
{
  m_ImageIO = itk::ImageIOFactory::CreateImageIO(path.c_str(), itk::IOFileModeEnum::WriteMode);
  if (m_ImageIO.IsNull())
  {
    throw std::runtime_error("cannot write " + path + ": no known image format has the ending '" +
                             fs::path(path).extension().string() + "'");
  }
  m_ImageIO->SetUseCompression(compress);
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

void
OutputImage::Begin(const ImageGrid & grid, PixelComponent component, const InputImage & input)
{
  const auto dimension = static_cast<unsigned int>(grid.Size.size());
  if (!m_ImageIO->SupportsDimension(dimension))
  {
    throw std::runtime_error("cannot write " + m_Path + ": its format does not hold images with " +
                             std::to_string(dimension) + " axes");
  }
  m_Folder = std::make_unique<TemporaryFolder>(m_Path);
  m_ImageIO->SetFileName(m_Folder->GetFileName().string());
  m_ImageIO->SetNumberOfDimensions(dimension);
  std::uint64_t bytes = GetPixelComponentSize(component) * input.NumberOfComponents;
  for (unsigned int axis = 0; axis < dimension; ++axis)
  {
    m_ImageIO->SetDimensions(axis, grid.Size[axis]);
    m_ImageIO->SetSpacing(axis, grid.Spacing[axis]);
    m_ImageIO->SetOrigin(axis, grid.Origin[axis]);
    m_ImageIO->SetDirection(axis, grid.Directions[axis]);
    bytes *= grid.Size[axis];
  }
  m_ImageIO->SetComponentType(component);
  m_ImageIO->SetNumberOfComponents(input.NumberOfComponents);
  m_ImageIO->SetPixelType(input.ImageIO->GetPixelType());
  m_ImageIO->SetMetaDataDictionary(input.ImageIO->GetMetaDataDictionary());
  m_ImageIO->SetUseStreamedWriting(this->CanStream());
  if (this->CanStream())
  {
    CheckDiskSpace(m_Folder->GetFileName().parent_path(), bytes);
  }
}

void
OutputImage::Write(const itk::ImageIORegion & region, const void * values)
{
  const fs::path file = m_Folder->GetFileName();
  const bool     isFirst = !fs::exists(file);
  m_ImageIO->SetIORegion(region);
  try
  {
    m_ImageIO->Write(values);
  }
  catch (const itk::ExceptionObject & error)
  {
    throw std::runtime_error("cannot write " + m_Path + ": " + error.GetDescription());
  }
  if (isFirst)
  {
    for (const auto & entry : fs::directory_iterator(file.parent_path()))
    {
      ReserveBlocks(entry.path());
    }
  }
}

void
OutputImage::Commit()
{
  const std::string file = m_Folder->GetFileName().string();
  const auto reader = itk::ImageIOFactory::CreateImageIO(file.c_str(), itk::IOFileModeEnum::ReadMode);
  if (reader.IsNull())
  {
    throw std::runtime_error("cannot write " + m_Path + ": what was written cannot be read back");
  }
  reader->SetFileName(file);
  reader->ReadImageInformation();
  CheckFileIsWhole(file, *reader);
  m_Folder->Commit();
}
