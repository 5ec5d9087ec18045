// SPDX-License-Identifier: Apache-2.0
#ifndef TiffScale_h
#define TiffScale_h

#include "tiff/TiffHandle.h"
#include "tiff/TiffStack.h"
#include "volumes/ImageDescription.h"

/** The text of the current page that describes the image; empty if there is none. */
std::string
GetTiffDescription(TIFF * tiff);

/** Completes the spacing of a stack along x and y from the current page's resolution, unless it is known; a resolution
 * that programs put down for printing, such as 72 dots per inch, says nothing of the voxels. */
void
CompleteTiffSpacing(TiffStack & stack, TIFF * tiff);

/** The spacing along each axis: 1 where it is not known. What had to be assumed is told. */
std::vector<double>
GetTiffSpacing(const TiffStack & stack, const std::string & name, bool isVolume, const WarningSink & warn);

#endif
