// SPDX-License-Identifier: Apache-2.0
#ifndef DicomPixels_h
#define DicomPixels_h

#include "dicom/DicomHeader.h"

#include <vector>

/** The stored pixels of all frames of a file, those of colours side by side.
 * \throw std::runtime_error if they are not what the header tells, or cannot be decoded */
std::vector<char>
DecodeDicomPixels(const DicomHeader & header);

#endif
