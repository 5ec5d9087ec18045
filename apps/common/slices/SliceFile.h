// SPDX-License-Identifier: Apache-2.0
#ifndef SliceFile_h
#define SliceFile_h

#include "tiff/TiffPixels.h"
#include "tiff/TiffStack.h"
#include "volumes/ImageDescription.h"

#include <memory>
#include <string>

/** One slice of a folder, open: its header was read and checked. */
class SliceFile
{
public:
  virtual ~SliceFile() = default;

  /** Size and type as a page has them. */
  virtual const TiffPage &
  GetPage() const = 0;

  /** What the file says of the spacing. */
  virtual TiffStack
  GetStack() const = 0;

  /** Bytes that reading a part of it takes beyond that part. */
  virtual std::uint64_t
  GetScratchBytes() const = 0;

  virtual void
  Read(const TiffRegion & region, void * pixels) = 0;
};

/** \throw std::runtime_error */
std::unique_ptr<SliceFile>
OpenTiffSlice(const std::string & path);

/** Opens a PNG, BMP or JPEG file by ITK.
 * \throw std::exception */
std::unique_ptr<SliceFile>
OpenPictureSlice(const std::string & path, const std::string & format);

#endif
