// SPDX-License-Identifier: Apache-2.0
#ifndef RealVoxels_h
#define RealVoxels_h

#include "volumes/VolumeReader.h"

/** Reads the voxels of a box, counted from the image's first voxel, as real numbers; integers beyond what the real type
 * holds are rounded.
 * \tparam TReal float or double */
template <typename TReal>
void
ReadReals(VolumeReader & reader, const itk::Subdivision::Box & box, TReal * values);

extern template void
ReadReals<float>(VolumeReader &, const itk::Subdivision::Box &, float *);
extern template void
ReadReals<double>(VolumeReader &, const itk::Subdivision::Box &, double *);

#endif
