// SPDX-License-Identifier: Apache-2.0
#ifndef ItkReader_h
#define ItkReader_h

#include "VolumeReader.h"

#include "itkImageIOBase.h"

#include <vector>

/** Reads an image file of any format that ITK reads. */
class ItkReader : public VolumeReader
{
public:
  /** \throw std::runtime_error that says why the file cannot be read, or is not whole */
  explicit ItkReader(const std::string & path);

  bool
  ReadsParts() const override;

  std::uint64_t
  GetScratchBytes(std::uint64_t partBytes) const override;

  void
  Read(const itk::Subdivision::Box & box, void * voxels) override;

private:
  void
  ReadRegion(const itk::Subdivision::Box & box, void * voxels);

  std::string               m_Path;
  itk::ImageIOBase::Pointer m_ImageIO; // has read the header
  bool                      m_ReadsParts;
  std::vector<char>         m_Whole;
};

/** Whether a name has an ending of NIfTI that is neither in small letters nor in capitals: its library knows no other. */
bool
HasNiftiEndingInMixedCase(const std::string & path);

/** What an exception says, less the place in the code that ITK's exceptions name. */
std::string
GetReason(const std::exception & error);

#endif
