// SPDX-License-Identifier: Apache-2.0
#include "itk/FileIntegrity.h"
#include "itk/FileLength.h"

#include "itkStreamingImageIOBase.h"

#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace
{
/** Reads the last voxel alone: reading regions, these formats do tell if there is nothing. */
void
CheckLastVoxel(const std::string & path, itk::ImageIOBase & imageIO)
{
  itk::ImageIORegion region(imageIO.GetNumberOfDimensions());
  for (unsigned int axis = 0; axis < imageIO.GetNumberOfDimensions(); ++axis)
  {
    region.SetIndex(axis, static_cast<itk::IndexValueType>(imageIO.GetDimensions(axis)) - 1);
    region.SetSize(axis, 1);
  }
  std::vector<char> voxel(imageIO.GetComponentSize() * imageIO.GetNumberOfComponents());
  imageIO.SetIORegion(region);
  try
  {
    imageIO.Read(voxel.data());
  }
  catch (const itk::ExceptionObject &)
  {
    throw std::runtime_error("cannot read " + path + ": it is truncated, and lacks its last voxel");
  }
}
} // namespace

void
CheckFileIsWhole(const std::string & path, itk::ImageIOBase & imageIO)
{
  const std::string format = imageIO.GetNameOfClass();
  const auto        bytes = static_cast<std::uint64_t>(imageIO.GetImageSizeInBytes());
  if (format == "NiftiImageIO")
  {
    CheckNiftiLength(path);
  }
  else if (format == "GiplImageIO")
  {
    CheckGiplLength(path, bytes);
  }
  else if (format == "MRCImageIO")
  {
    CheckMrcLength(path, bytes);
  }
  else if (format == "BMPImageIO")
  {
    CheckBmpLength(path);
  }
  else if (dynamic_cast<itk::StreamingImageIOBase *>(&imageIO) != nullptr && imageIO.CanStreamRead())
  {
    CheckLastVoxel(path, imageIO);
  }
}

void
CheckMessages(const std::string & path, const std::string & messages)
{
  // libtiff's errors look like "TIFFReadDirectory: Failed to read ..."; its warnings have "Warning" there.
  std::istringstream text(messages);
  for (std::string line; std::getline(text, line);)
  {
    if (line.rfind("TIFF", 0) == 0 && line.find(": Warning") == std::string::npos)
    {
      throw std::runtime_error("cannot read " + path + ": it is truncated or damaged: " + line);
    }
  }
}
