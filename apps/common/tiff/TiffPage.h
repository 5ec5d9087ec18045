// SPDX-License-Identifier: Apache-2.0
#ifndef TiffPage_h
#define TiffPage_h

#include "system/files/InputFile.h"
#include "tiff/TiffHandle.h"
#include "volumes/ImageDescription.h"

#include <cstdint>
#include <string>

/** How a page of a TIFF file holds its pixels, and what pixels it gives. */
struct TiffPage
{
  std::uint32_t                 Width = 0;
  std::uint32_t                 Height = 0;
  itk::Subdivision::ElementType Component{}; // of what is read
  unsigned int                  NumberOfComponents = 1;
  VoxelKind                     Kind = VoxelKind::Scalar;
  bool                          IsInverted = false;   // 0 is white: grey values are turned round
  bool                          HasColourMap = false; // that is more than a grey ramp
  std::uint16_t                 Bits = 8;             // of a component in the file
  bool                          IsHalf = false;       // 16-bit floating point
  bool                          IsPlanar = false;     // each component in a plane of its own
  bool                          IsTiled = false;
  bool                          IsCompressed = false;
  std::uint16_t                 Orientation = 1; // 1: rows from top to bottom, columns from left to right
  bool                          SaysOrientation = false;

  /** Whether the pixels of two pages make one volume. */
  bool
  HasPixelsLike(const TiffPage & other) const
  {
    return Width == other.Width && Height == other.Height && Component == other.Component &&
           NumberOfComponents == other.NumberOfComponents && Kind == other.Kind && HasColourMap == other.HasColourMap;
  }

  /** Whether the rows and columns of two pages, as they are stored, point the same way. */
  bool
  IsTurnedLike(const TiffPage & other) const
  {
    return Orientation == other.Orientation;
  }

  std::uint64_t
  GetPixelBytes() const
  {
    return NumberOfComponents * itk::Subdivision::SizeOf(Component);
  }

  /** For messages: "30 x 20 uint16". */
  std::string
  GetText() const;
};

/** Whether the current page is a smaller copy or a mask of another one. */
bool
IsThumbnail(TIFF * tiff);

/** Checks that the current page's directory lies within the file, with the link to the next page at its end: libtiff
 * takes a link that was cut off for the end of a file that is whole.
 * \throw std::runtime_error */
void
CheckTiffDirectory(const TiffHandle & tiff, const InputFile & file);

/** Describes the current page, checks that its pixels can be read as they are and that none of its strips or tiles lies
 * beyond the end of the file.
 * \param name what messages call the page by, such as "its page 3"
 * \throw std::runtime_error */
TiffPage
DescribeTiffPage(const TiffHandle & tiff, const std::string & name, std::uint64_t fileSize);

#endif
