// SPDX-License-Identifier: Apache-2.0
#include "dicom/DicomPixels.h"
#include "system/process/WatchedTask.h"

#include "gdcmByteValue.h"
#include "gdcmImageChangePlanarConfiguration.h"
#include "gdcmPixmapReader.h"

#include <stdexcept>

namespace
{
[[noreturn]] void
Fail(const DicomHeader & header, const std::string & reason)
{
  throw std::runtime_error("cannot read " + header.FileName.string() + ": " + reason);
}

/** Checks that the pixels are what the file's header told when it was opened. */
void
CheckPixmap(const DicomHeader & header, const gdcm::Pixmap & pixmap, std::size_t bytes)
{
  const gdcm::ByteValue * const plain = header.IsCompressed ? nullptr : pixmap.GetDataElement().GetByteValue();
  if (!header.IsCompressed && (plain == nullptr || plain->GetLength() < bytes))
  {
    Fail(header, "the DICOM file is truncated");
  }
  // Writers pad to an even number of bytes, and some a little further.
  const std::size_t rowBytes = header.GetFrameBytes() / header.Rows;
  if (plain != nullptr && plain->GetLength() >= bytes + rowBytes)
  {
    Fail(header,
         "its pixels take " + std::to_string(plain->GetLength()) + " bytes, but its header tells of " +
           std::to_string(bytes) + "; the size or the number of frames in the header is wrong");
  }
  if (pixmap.GetBufferLength() != bytes || pixmap.GetPixelFormat().GetBitsAllocated() != header.BitsAllocated)
  {
    Fail(header, "its pixels are not of the type or number that its header tells");
  }
}

/** Red, green and blue side by side, where they stand in planes. */
void
InterleavePlanes(const DicomHeader & header, std::vector<char> & bytes)
{
  const std::size_t       pixels = std::size_t{ header.Columns } * header.Rows;
  const std::vector<char> planes = bytes;
  for (std::size_t start = 0; start < bytes.size(); start += 3 * pixels)
  {
    const char * const red = planes.data() + start;
    gdcm::ImageChangePlanarConfiguration::RGBPlanesToRGBPixels(
      bytes.data() + start, red, red + pixels, red + 2 * pixels, pixels);
  }
}

} // namespace

std::vector<char>
DecodeDicomPixels(const DicomHeader & header)
{
  const WatchedTask  task("cannot read " + header.FileName.string());
  gdcm::PixmapReader reader;
  reader.SetFileName(header.FileName.c_str());
  if (!reader.Read())
  {
    Fail(header, "the DICOM file is damaged or truncated, or compressed in a way that GDCM does not know");
  }
  const gdcm::Pixmap & pixmap = reader.GetPixmap();
  std::vector<char>    bytes(header.GetFrameBytes() * header.Frames.size());
  CheckPixmap(header, pixmap, bytes.size());
  if (!pixmap.GetBuffer(bytes.data()))
  {
    Fail(header, "the pixels of the DICOM file cannot be decoded; it is damaged or truncated");
  }
  if (header.Samples == 3 && pixmap.GetPlanarConfiguration() == 1)
  {
    InterleavePlanes(header, bytes);
  }
  return bytes;
}
