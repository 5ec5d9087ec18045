// SPDX-License-Identifier: Apache-2.0
#ifndef TiffPageWriter_h
#define TiffPageWriter_h

#include "tiff/TiffHandle.h"
#include "volumes/ImageDescription.h"
#include "volumes/VolumeWriter.h"

#include <cstdint>
#include <string>
#include <vector>

/** Writes pages of one kind into a TIFF file, row by row. */
class TiffPageWriter
{
public:
  /** \param meant the name that messages call the file by
   * \throw std::runtime_error */
  TiffPageWriter(const std::string &      path,
                 const std::string &      meant,
                 const ImageDescription & description,
                 const OutputOptions &    options,
                 bool                     isBig);

  /** Begins a page. \param text what describes the image, or nothing */
  void
  BeginPage(const std::string & text);

  void
  WriteRows(const void * rows, std::uint64_t count);

  /** Completes a page, of which all rows were written. */
  void
  EndPage();

private:
  void
  SetTag(std::uint32_t tag, int value);
  void
  WriteStrip();

  TiffHandle                 m_Tiff;
  ImageDescription           m_Description;
  OutputOptions              m_Options;
  std::uint64_t              m_RowBytes;
  std::uint64_t              m_RowsPerStrip;
  std::uint64_t              m_Row = 0;
  std::vector<unsigned char> m_Strip; // the rows that were not written yet: strips are compressed as a whole
};

/** What ImageJ reads of a file with so many slices: how far apart they are, in the unit of the resolution. Empty where
 * ImageJ has no such images. */
std::string
MakeImageJText(const ImageDescription & description, std::uint64_t slices);

/** Whether a TIFF file was written by a TiffPageWriter, as its tag for the software says. */
bool
IsOwnTiff(const std::string & path);

/** Checks that TIFF can hold an image's pixels and grid, and warns of what is left out.
 * \throw std::runtime_error */
void
CheckForTiff(const std::string & path, const ImageDescription & description, const WarningSink & warn);

#endif
