// SPDX-License-Identifier: Apache-2.0
#ifndef OutputImage_h
#define OutputImage_h

#include "InputImage.h"
#include "TemporaryFolder.h"

#include <memory>
#include <string>
#include <vector>

/** The grid of an image: one entry for each axis. */
struct ImageGrid
{
  std::vector<itk::SizeValueType>  Size;
  std::vector<double>              Spacing;
  std::vector<double>              Origin;
  std::vector<std::vector<double>> Directions; // of the axes
};

/** The image file to write, region by region where its format allows, else all at once. It stands under its name only
 * once it is complete. */
class OutputImage
{
public:
  /** \throw std::runtime_error if no format writes files of that name */
  OutputImage(const std::string & path, bool compress);

  /** Whether it can be written region by region. */
  bool
  CanStream() const;

  /** Bytes that the format's writer needs for itself to write an image of the given size, in the worst case. */
  std::uint64_t
  GetWriterBytes(std::uint64_t imageBytes) const;

  /** Sets all but the pixel values; the kind of pixel and the meta-data are those of the input.
   * \throw std::runtime_error if the format cannot hold such an image, the disk is too full, or may not be written */
  void
  Begin(const ImageGrid & grid, PixelComponent component, const InputImage & input);

  /** Writes a region of the image. */
  void
  Write(const itk::ImageIORegion & region, const void * values);

  /** Gives the file its name. */
  void
  Commit();

private:
  using ImageIOPointer = itk::ImageIOBase::Pointer;

  /** A writer for files of the output's kind. */
  ImageIOPointer
  MakeImageIO() const;

  /** Writes a small image of the same kind and reads it back: the formats do not say what they can hold, and some
   * writers drop what they cannot. Returns whether the values came back unchanged. */
  bool
  Try(const ImageGrid & grid, PixelComponent component, const InputImage & input) const;

  /** Reads the file back as far as it must, to be sure that all was written. */
  void
  Verify(const void * values);

  std::string                      m_Path;
  bool                             m_Compress;
  ImageIOPointer                   m_ImageIO;
  bool                             m_IsLossless = false;
  std::unique_ptr<TemporaryFolder> m_Folder;
};

#endif
