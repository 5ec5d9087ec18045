// SPDX-License-Identifier: Apache-2.0
#ifndef ItkReader_h
#define ItkReader_h

#include "itk/LinkFolder.h"
#include "volumes/VolumeReader.h"

#include "itkImageIOBase.h"

#include <memory>
#include <vector>

/** Reads an image file of any format that ITK reads. */
class ItkReader : public VolumeReader
{
public:
  /** \param meantFormat the one that the name's ending says, for messages; empty for none
   * \param warn is told what of the file the image does not have
   * \throw std::runtime_error that says why the file cannot be read, or is not whole */
  explicit ItkReader(
    const std::string & path,
    const std::string & meantFormat = {},
    const WarningSink & warn = [](const auto &) {});

  ~ItkReader() override;

  std::vector<std::string>
  GetFiles() const override;

  bool
  ReadsParts() const override;

  std::uint64_t
  GetScratchBytes(std::uint64_t partBytes) const override;

  void
  Read(const itk::Subdivision::Box & box, void * voxels) override;

private:
  void
  ReadHeader();
  void
  ReadRegion(const itk::Subdivision::Box & box, void * voxels);

  std::string                 m_Path;
  std::string                 m_Name;    // that the format's reader knows the file by
  std::shared_ptr<LinkFolder> m_Links;   // where the file is opened by a link
  itk::ImageIOBase::Pointer   m_ImageIO; // has read the header
  bool                        m_ReadsParts;
  bool                        m_HasReadWhole = false;
  std::vector<char>           m_Whole;
};

#endif
