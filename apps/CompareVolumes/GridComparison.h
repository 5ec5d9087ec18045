// SPDX-License-Identifier: Apache-2.0
#ifndef GridComparison_h
#define GridComparison_h

#include "volumes/ImageDescription.h"

/** How far apart the same voxel of two grids of one size lies at most, in voxels of the first along any of its axes. */
double
GetLargestShift(const ImageGrid & first, const ImageGrid & second);

/** Names what two grids differ in: Spacing, Origin, Direction, with the values of both. */
std::string
DescribeDifference(const ImageGrid & first, const ImageGrid & second);

#endif
