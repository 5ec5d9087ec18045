// SPDX-License-Identifier: Apache-2.0
#ifndef DicomReader_h
#define DicomReader_h

#include "dicom/DicomGeometry.h"

/** Reads a DICOM series whose slices make a regular volume, slice by slice. Files with several frames are kept, once
 * decoded. */
class DicomReader : public VolumeReader
{
public:
  /** \throw std::runtime_error if the slices make no regular volume */
  DicomReader(std::string path, DicomSeries series, const InputOptions & options, const WarningSink & warn);

  std::vector<std::string>
  GetFiles() const override;

  bool
  ReadsParts() const override;

  std::uint64_t
  GetScratchBytes(std::uint64_t partBytes) const override;

  void
  Read(const itk::Subdivision::Box & box, void * voxels) override;

private:
  const DicomSeries m_Series;
  const DicomVolume m_Volume;

  std::map<const DicomHeader *, std::vector<char>> m_Kept;
};

#endif
