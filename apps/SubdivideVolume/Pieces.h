// SPDX-License-Identifier: Apache-2.0
#ifndef Pieces_h
#define Pieces_h

#include "itkImageRegion.h"

#include <cstdint>
#include <vector>

/** Every image is processed with four axes; those that its file lacks have one sample. */
inline constexpr unsigned int Axes = 4;

using ImageRegion = itk::ImageRegion<Axes>;

/** Splits an image into at least \c number regions of about the same size, if it has that many planes (2-D: rows).
 * Each region is contiguous in a file. */
std::vector<ImageRegion>
SplitIntoPieces(const ImageRegion & whole, std::uint64_t number);

/** The largest number of pieces that makes sense. */
std::uint64_t
GetMaximumNumberOfPieces(const ImageRegion & whole);

/** What a process of this size occupies now, in bytes. */
std::uint64_t
GetResidentBytes();

/** The memory of this machine, in bytes. */
std::uint64_t
GetMachineBytes();

#endif
