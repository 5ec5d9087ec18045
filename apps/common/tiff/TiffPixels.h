// SPDX-License-Identifier: Apache-2.0
#ifndef TiffPixels_h
#define TiffPixels_h

#include "tiff/TiffPage.h"

#include <cstdint>

/** A part of a page. */
struct TiffRegion
{
  std::uint32_t X = 0;
  std::uint32_t Y = 0;
  std::uint32_t Width = 0;
  std::uint32_t Height = 0;
};

/** Reads a part of the current page, which was described so, into pixels without gaps: the strips or tiles of it that
 * are needed, one at a time.
 * \throw std::runtime_error */
void
ReadTiffPixels(const TiffHandle & tiff, const TiffPage & page, const TiffRegion & region, void * pixels);

/** Turns components that a TIFF file holds side by side into those that are read: unpacked bits, half as float, grey
 * values with 0 as white turned round.
 * \param first how many components lie before them in the first byte's row */
void
ConvertTiffComponents(const TiffPage & page,
                      const void *     stored,
                      std::uint64_t    first,
                      std::uint64_t    count,
                      std::uint64_t    stride,
                      void *           components);

#endif
