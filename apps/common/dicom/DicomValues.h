// SPDX-License-Identifier: Apache-2.0
#ifndef DicomValues_h
#define DicomValues_h

#include "dicom/DicomGeometry.h"

#include <cstddef>
#include <vector>

/** Refuses files whose pixels are not all there or cannot be given as they are meant: palettes, luminance and
 * chrominance, single bits, real numbers.
 * \throw std::runtime_error */
void
CheckPixels(const DicomHeader & header);

/** A type that holds the values of all slices: the stored one where nothing is rescaled, the smallest integer from 16
 * bits on where slopes and intercepts are integers, else float, or double for 32 stored bits. */
itk::Subdivision::ElementType
ChooseValueType(const std::vector<DicomSlice> & slices);

/** Turns the stored numbers of a slice into values of a type: slope * stored + intercept, of grey pixels. */
void
ConvertToValues(const DicomSlice &            slice,
                const void *                  stored,
                std::size_t                   count,
                itk::Subdivision::ElementType type,
                void *                        values);

#endif
