// SPDX-License-Identifier: Apache-2.0
#ifndef DicomSeries_h
#define DicomSeries_h

#include "dicom/DicomHeader.h"
#include "volumes/ImageDescription.h"

#include <string>
#include <vector>

/** The image files that bear one series UID. */
struct DicomSeries
{
  std::vector<DicomHeader> Headers; // at least one

  std::size_t
  GetNumberOfFrames() const;
};

/** A file, or what is found in a folder and the folders below it; a DICOMDIR stands for its folder. In the order of the
 * series numbers.
 * \throw std::runtime_error if a DICOM file is damaged */
std::vector<DicomSeries>
FindDicomSeries(const std::string & path);

/** The series with a UID or a number, counted from 1; the only one, if none is named.
 * \throw std::runtime_error that lists all, if that is none or not clear */
DicomSeries
ChooseDicomSeries(const std::string & path, std::vector<DicomSeries> all, const std::string & wanted);

#endif
