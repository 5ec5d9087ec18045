// SPDX-License-Identifier: Apache-2.0
#include "dicom/Dicom.h"

#ifdef APPS_HAVE_GDCM
#  include "dicom/DicomCopies.h"
#  include "dicom/DicomReader.h"
#  include "system/files/RegularInput.h"
#endif

#include <algorithm>
#include <fstream>
#include <stdexcept>

bool
IsDicomFile(const std::string & path)
{
  std::ifstream file(path, std::ios::binary);
  char          start[132] = {};
  file.read(start, sizeof(start));
  return file && std::equal(start + 128, start + 132, "DICM");
}

#ifdef APPS_HAVE_GDCM

std::unique_ptr<VolumeReader>
OpenDicom(const std::string & path, const InputOptions & options, const WarningSink & warn)
{
  CheckIsRegularInput(path);
  DicomSeries series = ChooseDicomSeries(path, FindDicomSeries(path), options.Series);
  LeaveOutCopies(series, warn);
  return std::make_unique<DicomReader>(path, std::move(series), options, warn);
}

std::vector<DicomSeriesInfo>
ListDicomSeries(const std::string & folder)
{
  CheckIsRegularInput(folder);
  std::vector<DicomSeriesInfo> all;
  for (const DicomSeries & series : FindDicomSeries(folder))
  {
    const DicomHeader & first = series.Headers.front();
    all.push_back(
      { first.SeriesUid, first.Description, first.Modality, series.GetNumberOfFrames(), first.Columns, first.Rows });
  }
  if (all.empty())
  {
    throw std::runtime_error("cannot read " + folder + ": it holds no DICOM series with images");
  }
  return all;
}

#else

std::unique_ptr<VolumeReader>
OpenDicom(const std::string & path, const InputOptions &, const WarningSink &)
{
  throw std::runtime_error("cannot read " + path + ": this program was built without DICOM");
}

std::vector<DicomSeriesInfo>
ListDicomSeries(const std::string & folder)
{
  throw std::runtime_error("cannot read " + folder + ": this program was built without DICOM");
}

#endif

void
PrintDicomSeries(const std::vector<DicomSeriesInfo> & all, std::FILE * file)
{
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const DicomSeriesInfo & series = all[i];
    std::fprintf(file,
                 "%zu  %s  %s  %llu slices of %u x %u  %s\n",
                 i + 1,
                 series.Uid.c_str(),
                 series.Modality.c_str(),
                 static_cast<unsigned long long>(series.NumberOfSlices),
                 series.Columns,
                 series.Rows,
                 series.Description.c_str());
  }
}

void
RefuseDicomOutput(const std::string & path)
{
  throw std::runtime_error(
    "cannot write " + path +
    ": DICOM is not written, since a doubled volume is no acquisition of a scanner and its files "
    "would claim to be one; use .nrrd, .mha, .nii.gz or a folder of .tif slices");
}
