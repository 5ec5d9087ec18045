// SPDX-License-Identifier: Apache-2.0
#ifndef DicomGeometry_h
#define DicomGeometry_h

#include "dicom/DicomSeries.h"
#include "dicom/DicomSlice.h"
#include "volumes/VolumeReader.h"

#include <vector>

/** The slices of a regular volume, in the order of their positions along the normal, and the grid they make. */
struct DicomVolume
{
  std::vector<DicomSlice> Slices;
  ImageGrid               Grid;
};

/** Puts the slices of a series in order and checks that they make a regular volume: of one size, kind and orientation,
 * evenly spaced along the normal, without gap, repetition or tilt. A slice may be off its place by 1 % of the spacing
 * or 0.01 mm, whichever is more, but never by more than a tenth of the spacing; the last one may be shifted sideways
 * against the first by a tenth of a pixel.
 * \param options Frame chooses one of several images that stand at each position, Spacing stands for positions that the
 *   files do not have
 * \throw std::runtime_error that names the slices, the gap or the tilt */
DicomVolume
ArrangeDicomSlices(const DicomSeries & series, const InputOptions & options, const WarningSink & warn);

#endif
