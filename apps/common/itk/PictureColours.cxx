// SPDX-License-Identifier: Apache-2.0
#include "itk/PictureColours.h"

std::string
FindColourFault(const itk::ImageIOBase & imageIO)
{
  const std::string format = imageIO.GetNameOfClass();
  if (imageIO.GetNumberOfComponents() == 4 && format == "JPEGImageIO")
  {
    return "its colours are CMYK, which are not supported; convert it to RGB";
  }
  // The bytes of a pixel have several orders, and some leave the fourth without a meaning.
  if (imageIO.GetNumberOfComponents() == 4 && format == "BMPImageIO")
  {
    return "its pixels have 32 bits, which programs take in different orders; convert it to PNG, or to 24 bits";
  }
  return {};
}
