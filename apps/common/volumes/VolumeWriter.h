// SPDX-License-Identifier: Apache-2.0
#ifndef VolumeWriter_h
#define VolumeWriter_h

#include "volumes/ImageDescription.h"

#include <cstdint>
#include <filesystem>
#include <vector>

/** How the user wants the output written. */
struct OutputOptions
{
  bool         Compress = false;
  int          CompressionLevel = -1; // the format's own; else 1 to 9
  bool         KeepMetadata = false;
  unsigned int Threads = 1; // for compression
};

/** Writes an image that stands under its name only once it is complete. */
class VolumeWriter
{
public:
  virtual ~VolumeWriter() = default;

  /** The output, and whatever else gives way to it when it gets its name, be it there or not; a folder with all that it
   * holds. Known before Begin().
   * \throw std::runtime_error */
  virtual std::vector<std::filesystem::path>
  GetReplacedFiles() const = 0;

  /** Whether parts are written as they come, each a box that continues the one before (complete planes, or complete
   * rows of one plane); else all of the image must come in one Write(). */
  virtual bool
  WritesParts() const = 0;

  /** Bytes that the writer itself needs to write a part of so many bytes. */
  virtual std::uint64_t
  GetScratchBytes(std::uint64_t partBytes) const = 0;

  /** Checks that the format can hold such an image and that the disk has room, and lays out what can be laid out, under
   * a temporary name.
   * \throw std::runtime_error that says why not, in one sentence that names the output */
  virtual void
  Begin(const ImageDescription & description) = 0;

  /** Writes the voxels of a box, counted from the image's first voxel, x fastest, without gaps. */
  virtual void
  Write(const itk::Subdivision::Box & box, const void * voxels) = 0;

  /** Checks what was written, and gives it its name. Without it, the destructor removes all that was written. */
  virtual void
  Commit() = 0;
};

#endif
