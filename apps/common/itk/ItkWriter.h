// SPDX-License-Identifier: Apache-2.0
#ifndef ItkWriter_h
#define ItkWriter_h

#include "outputs/TemporaryFolder.h"
#include "volumes/VolumeWriter.h"

#include "itkImageIOBase.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>

/** Writes an image file of any format that ITK writes, all at once, in a folder where there is nothing else, and reads
 * back what was written. */
class ItkWriter : public VolumeWriter
{
public:
  /** \throw std::runtime_error if no format has the name's ending */
  ItkWriter(const std::string & path, const OutputOptions & options, const WarningSink & warn);

  std::vector<std::filesystem::path>
  GetReplacedFiles() const override;

  bool
  WritesParts() const override;

  std::uint64_t
  GetScratchBytes(std::uint64_t partBytes) const override;

  /** Writes a small image of the same kind first and reads it back: the formats do not say what they can hold, and some
   * of ITK's writers drop what they cannot. A warning tells what will be lost. */
  void
  Begin(const ImageDescription & description) override;

  void
  Write(const itk::Subdivision::Box & box, const void * voxels) override;

  void
  Commit() override;

private:
  using ImageIOPointer = itk::ImageIOBase::Pointer;

  ImageIOPointer
  MakeImageIO(const ImageDescription & description) const;
  void
  WriteFile(const ImageDescription & description, const void * voxels) const;
  void
  Try();
  void
  Compress();
  void
  CheckPartners() const;
  std::map<std::filesystem::path, std::filesystem::path>
  GetFinalNames() const;

  std::string                      m_Path;
  OutputOptions                    m_Options;
  WarningSink                      m_Warn;
  bool                             m_IsGzipped; // by this class: .nii.gz
  ImageDescription                 m_Description;
  bool                             m_IsLossless = true;
  std::unique_ptr<TemporaryFolder> m_Folder;
  std::filesystem::path            m_File; // that ITK writes
};

#endif
