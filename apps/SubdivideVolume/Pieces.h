// SPDX-License-Identifier: Apache-2.0
#ifndef Pieces_h
#define Pieces_h

#include "NonOscillatorySubdivision/ArrayView.h"

#include <cstdint>
#include <vector>

using itk::Subdivision::Box;
using itk::Subdivision::Interval;

/** The number of elements of a box. */
std::uint64_t
CountElements(const Box & box);

/** Splits a box into at least \c number boxes of about the same size, if it has so many rows. Each of them continues
 * the one before, so that in a file it is one range of bytes: complete planes, or complete rows of one plane. */
std::vector<Box>
SplitIntoPieces(const Box & whole, std::uint64_t number);

/** The largest number of pieces that makes sense: a row each. */
std::uint64_t
GetMaximumNumberOfPieces(const Box & whole);

#endif
