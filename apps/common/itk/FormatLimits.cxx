// SPDX-License-Identifier: Apache-2.0
#include "itk/FormatLimits.h"

#include <stdexcept>

namespace
{
[[noreturn]] void
Fail(const std::string & path, const std::string & reason)
{
  throw std::runtime_error("cannot write " + path + ": " + reason);
}

/** The largest size along an axis that a format's header can hold, or that ITK writes and reads; 0: no limit that
 * matters. */
std::uint64_t
GetLargestSize(const std::string & format)
{
  return format == "NiftiImageIO"                                                       ? 32767
         : format == "GiplImageIO" || format == "JPEGImageIO" || format == "MRCImageIO" ? 65535
         : format == "PNGImageIO"                                                       ? 1000000
         : format == "BMPImageIO"                                                       ? 2147483647
                                                                                        : 0;
}

void
CheckSize(const std::string & path, const ImageDescription & description, const itk::ImageIOBase & imageIO)
{
  const std::uint64_t largest = GetLargestSize(imageIO.GetNameOfClass());
  for (const std::uint64_t size : description.Grid.Size)
  {
    if (largest != 0 && size > largest)
    {
      Fail(path,
           "its format holds up to " + std::to_string(largest) + " voxels along an axis, not " + std::to_string(size) +
             "; .mha, .mhd and .nrrd have no such limit");
    }
  }
}

/** ITK writes other components than those into BMP and JPEG files, too, which programs take for other colours. */
void
CheckComponents(const std::string & path, const ImageDescription & description, const itk::ImageIOBase & imageIO)
{
  const std::string  format = imageIO.GetNameOfClass();
  const unsigned int components = description.NumberOfComponents;
  if ((format == "BMPImageIO" || format == "JPEGImageIO") && components != 1 && components != 3)
  {
    Fail(path,
         "its format holds grey values or colours of 3 components, not " + std::to_string(components) +
           " components; use .tif, .mha or .nrrd" + (components < 5 ? ", or .png in 2D" : ""));
  }
}
} // namespace

void
CheckFormatLimits(const std::string & path, const ImageDescription & description, const itk::ImageIOBase & imageIO)
{
  CheckSize(path, description, imageIO);
  CheckComponents(path, description, imageIO);
}
