// SPDX-License-Identifier: Apache-2.0
#include "dicom/DicomReader.h"
#include "dicom/DicomPixels.h"
#include "dicom/DicomValues.h"

#include <algorithm>
#include <stdexcept>

namespace
{
void
WarnOfPixels(const std::vector<DicomSlice> & slices, const WarningSink & warn)
{
  const DicomHeader & first = *slices.front().Header;
  if (first.Photometric == "MONOCHROME1")
  {
    warn("the DICOM images are MONOCHROME1, shown with black for the largest value; the values are kept as stored");
  }
  if (first.HasValueTable)
  {
    warn("the DICOM files hold a table that turns stored numbers into values (Modality LUT); the numbers are kept as "
         "stored");
  }
}

DicomVolume
Arrange(const std::string & path, const DicomSeries & series, const InputOptions & options, const WarningSink & warn)
{
  try
  {
    for (const DicomHeader & header : series.Headers)
    {
      CheckPixels(header);
    }
    return ArrangeDicomSlices(series, options, warn);
  }
  catch (const std::runtime_error & error)
  {
    throw std::runtime_error("cannot read " + path + ": " + error.what());
  }
}
} // namespace

DicomReader::DicomReader(std::string path, DicomSeries series, const InputOptions & options, const WarningSink & warn)
  : m_Series(std::move(series))
  , m_Volume(Arrange(path, m_Series, options, warn))
{
  const DicomHeader & first = *m_Volume.Slices.front().Header;
  WarnOfPixels(m_Volume.Slices, warn);
  m_Description.Grid = m_Volume.Grid;
  m_Description.Component = ChooseValueType(m_Volume.Slices);
  m_Description.NumberOfComponents = first.Samples;
  m_Description.Kind = first.Samples == 3 ? VoxelKind::Rgb : VoxelKind::Scalar;
  m_Description.Format = "DICOM";
  m_Description.Metadata = ReadDicomMetadata(first.FileName);
}

std::vector<std::string>
DicomReader::GetFiles() const
{
  std::vector<std::string> files;
  for (const DicomHeader & header : m_Series.Headers)
  {
    files.push_back(header.FileName.string());
  }
  return files;
}

bool
DicomReader::ReadsParts() const
{
  return std::all_of(m_Volume.Slices.begin(), m_Volume.Slices.end(), [](const auto & slice) {
    return slice.Header->Frames.size() == 1;
  });
}

std::uint64_t
DicomReader::GetScratchBytes(std::uint64_t) const
{
  std::uint64_t largest = 0;
  std::uint64_t kept = 0;
  for (const DicomHeader & header : m_Series.Headers)
  {
    const std::uint64_t bytes = header.GetFrameBytes() * header.Frames.size();
    largest = std::max(largest, bytes);
    kept += header.Frames.size() > 1 ? bytes : 0;
  }
  return kept + 3 * largest; // the file's bytes, the decoder's and their copy in order
}

void
DicomReader::Read(const itk::Subdivision::Box & box, void * voxels)
{
  auto *            out = static_cast<char *>(voxels);
  const std::size_t rowBytes = box[0].Size * m_Description.GetVoxelBytes();
  for (std::uint64_t z = 0; z < box[2].Size; ++z)
  {
    const DicomSlice &  slice = m_Volume.Slices[static_cast<std::size_t>(box[2].First) + z];
    const DicomHeader & header = *slice.Header;
    std::vector<char>   own;
    if (header.Frames.size() == 1)
    {
      own = DecodeDicomPixels(header);
    }
    else if (m_Kept.count(&header) == 0)
    {
      m_Kept[&header] = DecodeDicomPixels(header);
    }
    const char * const frame = own.empty() ? m_Kept[&header].data() + slice.Frame * header.GetFrameBytes() : own.data();
    const std::size_t  pixelBytes = header.GetFrameBytes() / header.Rows / header.Columns;
    for (std::uint64_t y = 0; y < box[1].Size; ++y, out += rowBytes)
    {
      const std::size_t row = static_cast<std::size_t>(box[1].First) + y;
      ConvertToValues(slice,
                      frame + (row * header.Columns + static_cast<std::size_t>(box[0].First)) * pixelBytes,
                      box[0].Size * header.Samples,
                      m_Description.Component,
                      out);
    }
  }
}
