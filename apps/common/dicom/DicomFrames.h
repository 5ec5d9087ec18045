// SPDX-License-Identifier: Apache-2.0
#ifndef DicomFrames_h
#define DicomFrames_h

#include "dicom/DicomHeader.h"

#include "gdcmDataSet.h"

/** Reads what a data set says of each of its frames: where they lie, how far apart their voxels are, and how stored
 * numbers become values. What stands in the functional groups of a frame holds before what stands in those that all
 * frames share, and this before what the file itself says.
 * \throw std::runtime_error if a number is none, or it tells of more or fewer frames than it has */
void
ReadDicomFrames(const gdcm::DataSet & data, DicomHeader & header);

#endif
