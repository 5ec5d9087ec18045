// SPDX-License-Identifier: Apache-2.0
#include "itk/Bitmap.h"

#include "itkBMPImageIO.h"

namespace
{
/** Whether a colour table says no more than the values do. */
bool
IsGreyRamp(const itk::BMPImageIO::PaletteType & palette)
{
  bool isRamp = palette.size() == 256;
  for (std::size_t i = 0; isRamp && i < palette.size(); ++i)
  {
    isRamp = palette[i].GetRed() == i && palette[i].GetGreen() == i && palette[i].GetBlue() == i;
  }
  return isRamp;
}

itk::BMPImageIO::Pointer
Open(const std::string & path, const bool hasColours)
{
  const auto bitmap = itk::BMPImageIO::New();
  bitmap->SetFileName(path);
  bitmap->SetExpandRGBPalette(hasColours);
  bitmap->ReadImageInformation();
  return bitmap;
}
} // namespace

itk::ImageIOBase::Pointer
OpenBitmap(const std::string & path)
{
  const auto values = Open(path, false);
  const bool hasColours = values->GetIsReadAsScalarPlusPalette() && !IsGreyRamp(values->GetColorPalette());
  return hasColours ? Open(path, true).GetPointer() : values.GetPointer();
}
