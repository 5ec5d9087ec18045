// SPDX-License-Identifier: Apache-2.0
#include "tiff/TiffPageWriter.h"

#include <algorithm>
#include <cstring>
#include <iomanip>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>

using itk::Subdivision::ElementType;
using itk::Subdivision::WithElementType;

namespace
{
int
GetSampleFormat(ElementType type)
{
  return WithElementType(type, [](auto tag) {
    using T = typename decltype(tag)::Type;
    return std::is_floating_point<T>::value ? SAMPLEFORMAT_IEEEFP
           : std::is_signed<T>::value       ? SAMPLEFORMAT_INT
                                            : SAMPLEFORMAT_UINT;
  });
}

/** Three or four components of whole numbers without a sign are colours to programs that show them, as ITK has it. */
bool
IsColour(const ImageDescription & description)
{
  const bool isVector = description.Kind == VoxelKind::Vector &&
                        (description.NumberOfComponents == 3 || description.NumberOfComponents == 4) &&
                        (description.Component == ElementType::UInt8 || description.Component == ElementType::UInt16);
  return description.Kind == VoxelKind::Rgb || description.Kind == VoxelKind::Rgba || isVector;
}

// Strips of this size are compressed well and quickly read in part.
constexpr std::uint64_t StripBytes = 1 << 18;

constexpr char Software[] = "NonOscillatorySubdivision";
} // namespace

TiffPageWriter::TiffPageWriter(const std::string &      path,
                               const std::string &      meant,
                               const ImageDescription & description,
                               const OutputOptions &    options,
                               bool                     isBig)
  : m_Tiff(path, isBig ? "w8" : "w", meant)
  , m_Description(description)
  , m_Options(options)
  , m_RowBytes(description.Grid.Size[0] * description.GetVoxelBytes())
  , m_RowsPerStrip(std::clamp<std::uint64_t>(StripBytes / m_RowBytes, 1, description.Grid.Size[1]))
{}

void
TiffPageWriter::SetTag(std::uint32_t tag, int value)
{
  if (TIFFSetField(m_Tiff, tag, value) == 0)
  {
    m_Tiff.Fail("its header cannot be written");
  }
}

void
TiffPageWriter::BeginPage(const std::string & text)
{
  const ImageGrid &  grid = m_Description.Grid;
  const unsigned int components = m_Description.NumberOfComponents;
  const bool         isColour = IsColour(m_Description);
  const auto         bytes = itk::Subdivision::SizeOf(m_Description.Component);
  this->SetTag(TIFFTAG_IMAGEWIDTH, static_cast<int>(grid.Size[0]));
  this->SetTag(TIFFTAG_IMAGELENGTH, static_cast<int>(grid.Size[1]));
  this->SetTag(TIFFTAG_SAMPLESPERPIXEL, static_cast<int>(components));
  this->SetTag(TIFFTAG_BITSPERSAMPLE, static_cast<int>(8 * bytes));
  this->SetTag(TIFFTAG_SAMPLEFORMAT, GetSampleFormat(m_Description.Component));
  this->SetTag(TIFFTAG_PHOTOMETRIC, isColour ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
  this->SetTag(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  this->SetTag(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  this->SetTag(TIFFTAG_ROWSPERSTRIP, static_cast<int>(m_RowsPerStrip));
  const unsigned int named = isColour ? 3 : 1;
  if (components > named)
  {
    std::vector<std::uint16_t> extra(components - named, isColour ? EXTRASAMPLE_UNASSALPHA : EXTRASAMPLE_UNSPECIFIED);
    TIFFSetField(m_Tiff, TIFFTAG_EXTRASAMPLES, static_cast<int>(extra.size()), extra.data());
  }
  this->SetTag(TIFFTAG_COMPRESSION, m_Options.Compress ? COMPRESSION_ADOBE_DEFLATE : COMPRESSION_NONE);
  if (m_Options.Compress)
  {
    // Not every program knows the predictors of floating point and of 64 bits.
    const bool hasPredictor = GetSampleFormat(m_Description.Component) != SAMPLEFORMAT_IEEEFP && bytes <= 4;
    this->SetTag(TIFFTAG_PREDICTOR, hasPredictor ? PREDICTOR_HORIZONTAL : PREDICTOR_NONE);
    if (m_Options.CompressionLevel > 0)
    {
      this->SetTag(TIFFTAG_ZIPQUALITY, m_Options.CompressionLevel);
    }
  }
  TIFFSetField(m_Tiff, TIFFTAG_SOFTWARE, Software);
  TIFFSetField(m_Tiff, TIFFTAG_XRESOLUTION, 10.0 / grid.Spacing[0]);
  TIFFSetField(m_Tiff, TIFFTAG_YRESOLUTION, 10.0 / grid.Spacing[1]);
  this->SetTag(TIFFTAG_RESOLUTIONUNIT, RESUNIT_CENTIMETER);
  if (!text.empty())
  {
    TIFFSetField(m_Tiff, TIFFTAG_IMAGEDESCRIPTION, text.c_str());
  }
  m_Row = 0;
}

void
TiffPageWriter::WriteRows(const void * rows, std::uint64_t count)
{
  const auto * bytes = static_cast<const unsigned char *>(rows);
  for (std::uint64_t row = 0; row < count; ++row)
  {
    m_Strip.insert(m_Strip.end(), bytes + row * m_RowBytes, bytes + (row + 1) * m_RowBytes);
    ++m_Row;
    if (m_Row % m_RowsPerStrip == 0 || m_Row == m_Description.Grid.Size[1])
    {
      this->WriteStrip();
    }
  }
}

void
TiffPageWriter::WriteStrip()
{
  const auto strip = static_cast<std::uint32_t>((m_Row - 1) / m_RowsPerStrip);
  const auto size = static_cast<tmsize_t>(m_Strip.size());
  if (TIFFWriteEncodedStrip(m_Tiff, strip, m_Strip.data(), size) != size)
  {
    m_Tiff.Fail("its pixels cannot be written; is the disk full?");
  }
  m_Strip.clear();
}

void
TiffPageWriter::EndPage()
{
  if (m_Row != m_Description.Grid.Size[1])
  {
    m_Tiff.Fail("a page has " + std::to_string(m_Row) + " of " + std::to_string(m_Description.Grid.Size[1]) + " rows");
  }
  if (TIFFWriteDirectory(m_Tiff) != 1)
  {
    m_Tiff.Fail("its header cannot be written; is the disk full?");
  }
}

bool
IsOwnTiff(const std::string & path)
{
  try
  {
    const TiffHandle tiff(path, "rm", path);
    const char *     software = nullptr;
    return TIFFGetField(tiff, TIFFTAG_SOFTWARE, &software) != 0 && std::strcmp(software, Software) == 0;
  }
  catch (const std::runtime_error &)
  {
    return false;
  }
}

std::string
MakeImageJText(const ImageDescription & description, std::uint64_t slices)
{
  const bool isRgb = IsColour(description) && description.NumberOfComponents == 3;
  const bool isKnown = description.Kind == VoxelKind::Scalar || isRgb;
  if (!isKnown || description.Grid.Size.size() < 3)
  {
    return "";
  }
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(15) << "ImageJ=1.53\nimages=" << slices;
  if (slices > 1)
  {
    text << "\nslices=" << slices;
  }
  text << "\nunit=cm\nspacing=" << description.Grid.Spacing[2] / 10.0 << "\nloop=false\n";
  return text.str();
}

void
CheckForTiff(const std::string & path, const ImageDescription & description, const WarningSink & warn)
{
  const ImageGrid & grid = description.Grid;
  const auto        fail = [&path](const std::string & reason) {
    throw std::runtime_error("cannot write " + path + ": " + reason);
  };
  if (grid.Size.size() < 2 || grid.Size.size() > 3)
  {
    fail("TIFF holds images of 2 or 3 axes, not of " + std::to_string(grid.Size.size()) +
         "; use .mha, .mhd, .nrrd or .nii.gz");
  }
  if (description.Kind == VoxelKind::Complex || description.Kind == VoxelKind::SymmetricTensor)
  {
    fail("TIFF holds no complex numbers and tensors; use .mha, .mhd or .nrrd");
  }
  const std::uint64_t most = std::numeric_limits<std::int32_t>::max();
  if (grid.Size[0] * description.GetVoxelBytes() > most || grid.Size[1] > most ||
      description.NumberOfComponents > std::numeric_limits<std::uint16_t>::max())
  {
    fail("its slices are too large for TIFF; use .mha, .mhd or .nrrd");
  }
  bool isPlain = true;
  for (std::size_t axis = 0; axis < grid.Size.size(); ++axis)
  {
    isPlain = isPlain && grid.Origin[axis] == 0.0;
    for (std::size_t entry = 0; entry < grid.Size.size(); ++entry)
    {
      isPlain = isPlain && grid.Directions[axis][entry] == (axis == entry ? 1.0 : 0.0);
    }
  }
  if (!isPlain)
  {
    warn("TIFF holds no origin and no direction: those of the image are not in " + path);
  }
}
