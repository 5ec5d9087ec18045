// SPDX-License-Identifier: Apache-2.0
#ifndef Dicom_h
#define Dicom_h

#include "volumes/VolumeReader.h"

#include <cstdio>
#include <memory>

/** A series as --list-series shows it. */
struct DicomSeriesInfo
{
  std::string   Uid;
  std::string   Description;
  std::string   Modality;
  std::uint64_t NumberOfSlices;
  unsigned int  Columns;
  unsigned int  Rows;
};

/** Whether a file says that it is DICOM, by the letters behind its preamble. */
bool
IsDicomFile(const std::string & path);

/** Opens a DICOM series: the only one of a folder, or of a folder below it, or the one that the options name; a
 * DICOMDIR stands for its folder; or a single file. Checks that the slices make a regular volume.
 * \throw std::runtime_error that says why they do not */
std::unique_ptr<VolumeReader>
OpenDicom(const std::string & path, const InputOptions & options, const WarningSink & warn);

/** The series of a folder and of the folders below it, in the order that --series counts them in, from 1.
 * \throw std::runtime_error if there are none */
std::vector<DicomSeriesInfo>
ListDicomSeries(const std::string & folder);

/** A line for each: number, UID, modality, slices, size and description. */
void
PrintDicomSeries(const std::vector<DicomSeriesInfo> & all, std::FILE * file);

/** \throw std::runtime_error that says why DICOM is not written, and which formats are */
[[noreturn]] void
RefuseDicomOutput(const std::string & path);

#endif
