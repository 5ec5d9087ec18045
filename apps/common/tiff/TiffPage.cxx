// SPDX-License-Identifier: Apache-2.0
#include "tiff/TiffPage.h"

using itk::Subdivision::ElementType;

namespace
{
template <typename T>
T
GetTag(TIFF * tiff, std::uint32_t tag)
{
  T value{};
  TIFFGetFieldDefaulted(tiff, tag, &value);
  return value;
}

ElementType
IntegerOf(unsigned int bits, bool isSigned)
{
  const int width = bits <= 8 ? 0 : bits <= 16 ? 2 : bits == 32 ? 4 : 6;
  return static_cast<ElementType>(width + (isSigned ? 1 : 0));
}

/** Component type, bits and whether it is a half float. Bits that fill no bytes are unpacked where they are unsigned.
 */
void
SetComponent(TiffPage & page, const TiffHandle & tiff, const std::string & name)
{
  page.Bits = GetTag<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE);
  const auto format = GetTag<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT);
  const bool isWhole = page.Bits == 8 || page.Bits == 16 || page.Bits == 32 || page.Bits == 64;
  if (format == SAMPLEFORMAT_IEEEFP && isWhole && page.Bits != 8)
  {
    page.IsHalf = page.Bits == 16;
    page.Component = page.Bits == 64 ? ElementType::Double : ElementType::Float;
  }
  else if ((format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_VOID) &&
           (isWhole || (page.Bits > 0 && page.Bits < 16)))
  {
    page.Component = IntegerOf(page.Bits, false);
  }
  else if (format == SAMPLEFORMAT_INT && isWhole)
  {
    page.Component = IntegerOf(page.Bits, true);
  }
  else
  {
    const bool isComplex = format == SAMPLEFORMAT_COMPLEXINT || format == SAMPLEFORMAT_COMPLEXIEEEFP;
    tiff.Fail(name + " has " + (isComplex ? "complex " : "") + "components of " + std::to_string(page.Bits) +
              (format == SAMPLEFORMAT_IEEEFP ? "-bit floating point" : " bits") +
              ", which are not supported; convert it to 8, 16 or 32 bits");
  }
}

/** Whether a colour map says no more than the values do: a grey ramp. */
bool
IsGreyRamp(TIFF * tiff, unsigned int bits)
{
  std::uint16_t * red = nullptr;
  std::uint16_t * green = nullptr;
  std::uint16_t * blue = nullptr;
  if (bits < 1 || bits > 16 || TIFFGetField(tiff, TIFFTAG_COLORMAP, &red, &green, &blue) == 0)
  {
    return false;
  }
  const std::uint32_t last = (1u << bits) - 1;
  for (std::uint32_t i = 0; i <= last; ++i)
  {
    const std::uint32_t least = i << (16 - bits);
    const std::uint32_t most = (65535u * i + last - 1) / last;
    if (red[i] != green[i] || red[i] != blue[i] || red[i] < least || red[i] > most)
    {
      return false;
    }
  }
  return true;
}

void
SetKind(TiffPage & page, const TiffHandle & tiff, const std::string & name)
{
  page.NumberOfComponents = GetTag<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL);
  page.IsPlanar =
    page.NumberOfComponents > 1 && GetTag<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG) == PLANARCONFIG_SEPARATE;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
  const auto compression = GetTag<std::uint16_t>(tiff, TIFFTAG_COMPRESSION);
  if (photometric == PHOTOMETRIC_YCBCR && compression == COMPRESSION_JPEG && !page.IsPlanar)
  {
    photometric = PHOTOMETRIC_RGB; // the codec is told to convert it, where it is read
  }
  const unsigned int components = page.NumberOfComponents;
  page.Kind = components > 1 ? VoxelKind::Vector : VoxelKind::Scalar;
  switch (photometric)
  {
    case PHOTOMETRIC_MINISBLACK:
      return;
    case PHOTOMETRIC_MINISWHITE:
      page.IsInverted = true;
      if (page.Component == ElementType::Float || page.Component == ElementType::Double ||
          page.Component == IntegerOf(page.Bits, true))
      {
        tiff.Fail(name + " has values of which 0 is white and which are signed; convert it to one with 0 as black");
      }
      return;
    case PHOTOMETRIC_RGB:
      page.Kind = components == 3 ? VoxelKind::Rgb : components == 4 ? VoxelKind::Rgba : VoxelKind::Vector;
      if (components >= 3)
      {
        return;
      }
      tiff.Fail(name + " is damaged: colours of " + std::to_string(components) + " components");
    case PHOTOMETRIC_PALETTE:
      page.HasColourMap = !IsGreyRamp(tiff, page.Bits);
      if (components == 1 && page.Component != IntegerOf(page.Bits, true))
      {
        return;
      }
      tiff.Fail(name + " is damaged: a colour table for other than single unsigned values");
    default:
      tiff.Fail(name + " has colours of a kind that is not supported (photometric interpretation " +
                std::to_string(photometric) + "); convert it to grey values or RGB");
  }
}

void
CheckCompression(TiffPage & page, const TiffHandle & tiff, const std::string & name)
{
  const auto compression = GetTag<std::uint16_t>(tiff, TIFFTAG_COMPRESSION);
  page.IsCompressed = compression != COMPRESSION_NONE;
  if (compression == COMPRESSION_JPEG && page.Bits != 8)
  {
    tiff.Fail(name + " is compressed as JPEG of " + std::to_string(page.Bits) +
              " bits, which the TIFF library does not read; save it with another compression");
  }
  if (TIFFIsCODECConfigured(compression) == 0)
  {
    const TIFFCodec * codec = TIFFFindCODEC(compression);
    tiff.Fail(name + " is compressed by a method that the TIFF library lacks (" +
              (codec != nullptr ? std::string(codec->name) : std::to_string(compression)) +
              "); save it with another compression");
  }
}

/** Bytes of an uncompressed strip or tile. */
std::uint64_t
GetStrileBytes(const TiffPage & page, TIFF * tiff, std::uint32_t strile)
{
  if (page.IsTiled)
  {
    return TIFFTileSize64(tiff);
  }
  const auto          rows = GetTag<std::uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP);
  const std::uint64_t strips = page.Height / rows + (page.Height % rows != 0 ? 1 : 0);
  const std::uint64_t before = (strile % strips) * rows;
  return TIFFVStripSize64(tiff, static_cast<std::uint32_t>(std::min<std::uint64_t>(rows, page.Height - before)));
}

void
CheckThatDataIsThere(const TiffPage & page, const TiffHandle & tiff, const std::string & name, std::uint64_t fileSize)
{
  if (!page.IsTiled && GetTag<std::uint32_t>(tiff, TIFFTAG_ROWSPERSTRIP) == 0)
  {
    tiff.Fail(name + " is damaged: strips without rows");
  }
  const std::uint32_t striles = page.IsTiled ? TIFFNumberOfTiles(tiff) : TIFFNumberOfStrips(tiff);
  if (striles == 0)
  {
    tiff.Fail(name + " is damaged: it has no pixels");
  }
  for (std::uint32_t strile = 0; strile < striles; ++strile)
  {
    const std::uint64_t offset = TIFFGetStrileOffset(tiff, strile);
    const std::uint64_t bytes = TIFFGetStrileByteCount(tiff, strile);
    if (offset == 0 || bytes == 0 || (!page.IsCompressed && bytes < GetStrileBytes(page, tiff, strile)))
    {
      tiff.Fail(name + " lacks a part of its pixels");
    }
    if (offset > fileSize || bytes > fileSize - offset)
    {
      tiff.Fail("it is truncated: the pixels of " + name + " end " + std::to_string(offset + bytes - fileSize) +
                " bytes beyond its end");
    }
  }
}
} // namespace

std::string
TiffPage::GetText() const
{
  const std::string components =
    NumberOfComponents == 1 ? "" : " of " + std::to_string(NumberOfComponents) + " components";
  return std::to_string(Width) + " x " + std::to_string(Height) + ' ' + itk::Subdivision::GetName(Component) +
         components + (HasColourMap ? " with a colour table" : "");
}

bool
IsThumbnail(TIFF * tiff)
{
  std::uint32_t type = 0;
  std::uint16_t oldType = 0;
  if (TIFFGetField(tiff, TIFFTAG_SUBFILETYPE, &type) != 0)
  {
    return (type & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) != 0;
  }
  return TIFFGetField(tiff, TIFFTAG_OSUBFILETYPE, &oldType) != 0 && oldType == OFILETYPE_REDUCEDIMAGE;
}

void
CheckTiffDirectory(const TiffHandle & tiff, const InputFile & file)
{
  const bool          isBig = file.ReadTextAt(2, 2).find(43) != std::string::npos;
  const std::size_t   countBytes = isBig ? 8 : 2;
  const std::uint64_t entryBytes = isBig ? 20 : 12;
  const std::uint64_t linkBytes = isBig ? 8 : 4;
  const std::uint64_t offset = TIFFCurrentDirOffset(tiff);
  const std::string   bytes = file.ReadTextAt(offset, countBytes);
  std::uint64_t       entries = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
  {
    const std::size_t byte = TIFFIsBigEndian(tiff) != 0 ? i : bytes.size() - 1 - i;
    entries = 256 * entries + static_cast<unsigned char>(bytes[byte]);
  }
  // libtiff reads no directory with more than 65535 entries.
  if (bytes.size() < countBytes || entries > 65535 ||
      file.GetSize() - offset < countBytes + entries * entryBytes + linkBytes)
  {
    tiff.Fail("it is truncated within its header");
  }
}

TiffPage
DescribeTiffPage(const TiffHandle & tiff, const std::string & name, std::uint64_t fileSize)
{
  TiffPage page;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &page.Width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &page.Height);
  std::uint32_t depth = 1;
  TIFFGetField(tiff, TIFFTAG_IMAGEDEPTH, &depth);
  if (page.Width == 0 || page.Height == 0 || depth != 1)
  {
    tiff.Fail(name + (depth > 1 ? " is a volume by itself, which is not supported; save it as a page for each slice"
                                : " is damaged: it has no pixels"));
  }
  page.IsTiled = TIFFIsTiled(tiff) != 0;
  page.Orientation = GetTag<std::uint16_t>(tiff, TIFFTAG_ORIENTATION);
  std::uint16_t orientation = 0;
  page.SaysOrientation = TIFFGetField(tiff, TIFFTAG_ORIENTATION, &orientation) != 0;
  SetComponent(page, tiff, name);
  SetKind(page, tiff, name);
  CheckCompression(page, tiff, name);
  CheckThatDataIsThere(page, tiff, name, fileSize);
  return page;
}
