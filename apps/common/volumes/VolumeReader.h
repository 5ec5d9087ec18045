// SPDX-License-Identifier: Apache-2.0
#ifndef VolumeReader_h
#define VolumeReader_h

#include "volumes/ImageDescription.h"

#include <optional>
#include <string>
#include <vector>

/** How a file without a header holds its voxels. */
struct RawLayout
{
  std::vector<std::uint64_t>    Size; // x, y, z, t
  itk::Subdivision::ElementType Component{};
  unsigned int                  NumberOfComponents = 1;
  bool                          IsBigEndian = false;
  std::uint64_t                 HeaderBytes = 0;
};

/** What the user says of an input beyond its name. */
struct InputOptions
{
  std::string                        Series;  // of DICOM: a UID, or a number of the list that --list-series prints
  std::optional<RawLayout>           Raw;     // --raw
  std::optional<std::vector<double>> Spacing; // override the file's
  std::optional<std::vector<double>> Origin;
  std::optional<unsigned int>        Channel; // of a multi-channel file, counted from 0
  std::optional<unsigned int>        Frame;   // of a time series, counted from 0
};

/** Reads the voxels of an image that was opened: part by part where the format allows it, else it holds all of it. */
class VolumeReader
{
public:
  virtual ~VolumeReader() = default;

  const ImageDescription &
  GetDescription() const
  {
    return m_Description;
  }

  /** Puts the spacing, a number for each axis or one for all, and the origin that the user gave in place of the file's;
   * a warning says so.
   * \throw std::runtime_error if they are no grid's */
  void
  OverrideGrid(const std::string & path, const InputOptions & options, const WarningSink & warn);

  /** All files that the image is read from. */
  virtual std::vector<std::string>
  GetFiles() const = 0;

  /** Whether a part is read without the rest: else the reader keeps the whole image after the first Read(). */
  virtual bool
  ReadsParts() const = 0;

  /** Bytes that the reader itself needs to read a part of so many bytes. */
  virtual std::uint64_t
  GetScratchBytes(std::uint64_t partBytes) const = 0;

  /** Reads the voxels of a box, counted from the image's first voxel, in the machine's byte order, x fastest, without
   * gaps.
   * \throw std::runtime_error that says why, in one sentence that names the file */
  virtual void
  Read(const itk::Subdivision::Box & box, void * voxels) = 0;

protected:
  ImageDescription m_Description;
};

#endif
