// SPDX-License-Identifier: Apache-2.0
#ifndef DicomHeader_h
#define DicomHeader_h

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

/** An image of one plane, as a DICOM file describes it: a slice, or a frame of several. */
struct DicomFrame
{
  std::optional<std::array<double, 3>> Position;     // mm, of the centre of the first voxel
  std::optional<std::array<double, 6>> Orientation;  // of the rows, then of the columns
  std::optional<std::array<double, 2>> PixelSpacing; // mm, along x and y
  std::optional<double>                SliceSpacing; // mm, from slice to slice or of one slice
  bool                                 IsSlopeTold = false;
  bool                                 IsInterceptTold = false;
  double                               Slope = 1; // value = slope * stored + intercept
  double                               Intercept = 0;
  std::vector<double>                  PhaseKey; // sorts the images that stand at one position
};

/** What a DICOM file tells of its image before the voxels. */
struct DicomHeader
{
  std::filesystem::path FileName;
  std::string           SeriesUid;
  std::string           InstanceUid;
  std::string           Description;
  std::string           Modality;
  std::string           Photometric;
  double                SeriesNumber = 0;
  std::optional<double> InstanceNumber;
  unsigned int          Columns = 0;
  unsigned int          Rows = 0;
  unsigned int          Samples = 1;
  unsigned int          BitsAllocated = 0;
  unsigned int          BitsStored = 0;
  unsigned int          HighBit = 0;
  bool                  IsSigned = false;
  bool                  IsCompressed = false;
  bool                  IsBigEndian = false;
  bool                  IsTruncated = false;   // the file ends before its last voxel
  bool                  HasValueTable = false; // a Modality LUT Sequence
  bool                  HasRealPixels = false; // Float Pixel Data, or Double Float Pixel Data

  std::vector<DicomFrame> Frames; // at least one

  std::uint64_t
  GetFrameBytes() const
  {
    return std::uint64_t{ Columns } * Rows * Samples * (BitsAllocated / 8);
  }
};

/** Reads a file up to its voxels.
 * \return nothing if it is no DICOM file or one without an image, such as a report
 * \throw std::runtime_error if it cannot be read so far */
std::optional<DicomHeader>
ReadDicomHeader(const std::filesystem::path & path);

/** All plain values before the voxels, by keys such as "0010|0010"; modality and unit also as "Modality", "Units". */
std::map<std::string, std::string>
ReadDicomMetadata(const std::filesystem::path & path);

#endif
