// SPDX-License-Identifier: Apache-2.0
#ifndef DicomPositions_h
#define DicomPositions_h

#include "dicom/DicomSlice.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

/** Names some slices for a message: by file, and by frame, counted from 1, where a file has several. */
std::string
NameSlices(const std::vector<DicomSlice> & slices);

/** Unit vectors along rows, columns and the normal.
 * \throw std::runtime_error if the first two are not at right angles */
std::array<std::array<double, 3>, 3>
GetSliceAxes(const DicomSlice & slice);

/** Sorts slices, all of which have positions, along the normal; where several stand at each position, takes one there.
 * \param pixel the spacing in the plane
 * \param phase which one of those at a position, counted from 0
 * \throw std::runtime_error if one is to be chosen and was not, or the numbers of images at the positions differ */
std::vector<DicomSlice>
ChoosePhase(std::vector<DicomSlice> slices, double pixel, const std::optional<unsigned int> & phase);

/** The spacing of two or more slices, sorted along the normal.
 * \throw std::runtime_error if they are not evenly spaced, or not straight above each other */
double
CheckPositions(const std::vector<DicomSlice> & slices, double pixel);

#endif
