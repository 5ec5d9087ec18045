// SPDX-License-Identifier: Apache-2.0
#include "nifti/NiftiHeader.h"
#include "nifti/NiftiFiles.h"
#include "text/HeaderText.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <zlib.h>

namespace
{
/** Where numbers stand. */
constexpr std::size_t Dimensions = 40;
constexpr std::size_t Intent = 68;
constexpr std::size_t DataType = 70;
constexpr std::size_t Bits = 72;
constexpr std::size_t Spacings = 76;
constexpr std::size_t DataOffset = 108;
constexpr std::size_t Slope = 112;
constexpr std::size_t Intercept = 116;
constexpr std::size_t Units = 123;
constexpr std::size_t TimeOffset = 136;
constexpr std::size_t QuaternionCode = 252;
constexpr std::size_t MatrixCode = 254;
constexpr std::size_t Quaternion = 256;
constexpr std::size_t Offsets = 268;
constexpr std::size_t Rows = 280;
constexpr std::size_t Magic = 344;

/** Types of voxels that are not one number of a type of C++. */
constexpr int Complex64 = 32;
constexpr int Rgb24 = 128;
constexpr int Complex128 = 1792;
constexpr int Rgba32 = 2304;

/** Millimetres in the unit of space; what is none of the known units is taken for millimetres. */
double
GetMillimetres(unsigned int units)
{
  const unsigned int unit = units & 7;
  return unit == 1 ? 1e3 : unit == 3 ? 1e-3 : 1.0;
}

/** Seconds in the unit of time; the fourth axis may have another unit, which stays. */
double
GetSeconds(unsigned int units)
{
  const unsigned int unit = units & 56;
  return unit == 16 ? 1e-3 : unit == 24 ? 1e-6 : 1.0;
}
} // namespace

NiftiHeader::NiftiHeader(const std::string & path)
{
  const gzFile file = gzopen(path.c_str(), "rb");
  m_IsComplete = file != nullptr && gzread(file, m_Bytes.data(), Size) == static_cast<int>(Size);
  if (file != nullptr)
  {
    m_IsCompressed = gzdirect(file) == 0;
    gzclose(file);
  }
  m_IsSwapped = this->Get<std::int16_t>(Dimensions) < 1 || this->Get<std::int16_t>(Dimensions) > 7;
}

template <typename T>
T
NiftiHeader::Get(const std::size_t offset) const
{
  std::array<char, sizeof(T)> bytes;
  std::copy_n(m_Bytes.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), bytes.begin());
  if (m_IsSwapped)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  T number;
  std::memcpy(&number, bytes.data(), sizeof(T));
  return number;
}

bool
NiftiHeader::IsNifti() const
{
  const char * const magic = m_Bytes.data() + Magic;
  return m_IsComplete && (std::memcmp(magic, "n+1", 4) == 0 || std::memcmp(magic, "ni1", 4) == 0);
}

bool
NiftiHeader::IsSingleFile() const
{
  return this->IsNifti() && m_Bytes[Magic + 1] == '+';
}

bool
NiftiHeader::IsOfPair() const
{
  return m_IsComplete && this->Get<std::int32_t>(0) == static_cast<std::int32_t>(Size);
}

bool
NiftiHeader::IsOfVersion2() const
{
  return m_IsComplete &&
         (std::memcmp(m_Bytes.data() + 4, "n+2", 3) == 0 || std::memcmp(m_Bytes.data() + 4, "ni2", 3) == 0);
}

bool
NiftiHeader::IsBigEndian() const
{
  const std::uint16_t one = 1;
  const bool          isMachineBig = *reinterpret_cast<const unsigned char *>(&one) == 0;
  return isMachineBig != m_IsSwapped;
}

std::optional<itk::Subdivision::ElementType>
NiftiHeader::GetComponent() const
{
  using itk::Subdivision::ElementType;
  switch (this->Get<std::int16_t>(DataType))
  {
    case 2:
    case Rgb24:
    case Rgba32:
      return ElementType::UInt8;
    case 4:
      return ElementType::Int16;
    case 8:
      return ElementType::Int32;
    case 16:
    case Complex64:
      return ElementType::Float;
    case 64:
    case Complex128:
      return ElementType::Double;
    case 256:
      return ElementType::Int8;
    case 512:
      return ElementType::UInt16;
    case 768:
      return ElementType::UInt32;
    case 1024:
      return ElementType::Int64;
    case 1280:
      return ElementType::UInt64;
    default:
      return std::nullopt;
  }
}

unsigned int
NiftiHeader::CountComponentsSideBySide() const
{
  switch (this->Get<std::int16_t>(DataType))
  {
    case Complex64:
    case Complex128:
      return 2;
    case Rgb24:
      return 3;
    case Rgba32:
      return 4;
    default:
      return 1;
  }
}

bool
NiftiHeader::HoldsDisplacements() const
{
  return this->Get<std::int16_t>(Intent) == 1006;
}

std::optional<std::pair<double, double>>
NiftiHeader::GetRescaling() const
{
  constexpr double least = std::numeric_limits<double>::epsilon();
  const double     stored = this->Get<float>(Slope);
  const double     slope = std::abs(stored) < least ? 1.0 : stored;
  const double     intercept = this->Get<float>(Intercept);
  const bool       changes = std::abs(slope - 1.0) > least || std::abs(intercept) > least;
  // Analyze has no slope there.
  return this->IsNifti() && changes ? std::make_optional(std::make_pair(slope, intercept)) : std::nullopt;
}

bool
NiftiHeader::HasDataOffset() const
{
  const float offset = this->Get<float>(DataOffset);
  return offset >= 0 && offset < 1e15f && offset == std::floor(offset);
}

std::uint64_t
NiftiHeader::GetDataOffset() const
{
  const float offset = this->Get<float>(DataOffset);
  return offset >= 0 && offset < 1e15f ? static_cast<std::uint64_t>(offset) : 0;
}

std::uint64_t
NiftiHeader::GetDataBytes() const
{
  constexpr int           mostAxes = 7; // of a header; where it says more, it is none
  constexpr std::uint64_t mostBits = std::uint64_t{ 1 } << 60;
  std::uint64_t           bits = this->Get<std::uint16_t>(Bits);
  for (int axis = 1; axis <= std::min<int>(mostAxes, this->Get<std::int16_t>(Dimensions)); ++axis)
  {
    const std::uint64_t size = this->Get<std::uint16_t>(Dimensions + 2 * static_cast<std::size_t>(axis));
    bits = size > 0 && bits > mostBits / size ? mostBits : bits * size;
  }
  return bits / 8;
}

void
NiftiHeader::CompleteUnits(ImageGrid & grid) const
{
  const auto units = static_cast<unsigned char>(m_Bytes[Units]);
  for (std::size_t axis = 0; axis < 3 && axis < grid.Origin.size(); ++axis)
  {
    grid.Origin[axis] *= GetMillimetres(units);
  }
  if (grid.Size.size() > 3)
  {
    const double start = this->Get<float>(TimeOffset);
    grid.Spacing[3] *= GetSeconds(units);
    grid.Origin[3] = this->IsPlaced() && std::isfinite(start) ? start * GetSeconds(units) : 0.0;
  }
}

std::string
NiftiHeader::FindFault() const
{
  constexpr std::uint64_t least = Size + 4; // the header, and whether extensions follow
  const float             intercept = this->Get<float>(Intercept);
  if (m_Bytes[Magic] == 'n' && !this->IsNifti())
  {
    return "its header's magic is neither NIfTI's (n+1, ni1) nor Analyze's; set it to one of these";
  }
  if (this->IsSingleFile() && this->GetDataOffset() < least)
  {
    return "its header says that its voxels start at byte " + std::to_string(this->GetDataOffset()) +
           ", where the header itself is; they start at 352 or later (vox_offset)";
  }
  const auto component = this->GetComponent();
  const auto bits = std::size_t{ this->Get<std::uint16_t>(Bits) };
  const auto typeBits = component ? 8 * this->CountComponentsSideBySide() * itk::Subdivision::SizeOf(*component) : bits;
  if (bits != typeBits)
  {
    return "its header says that a voxel has " + std::to_string(bits) + " bits (bitpix), but its type has " +
           std::to_string(typeBits) + " (datatype); set the wrong one right";
  }
  if (this->IsNifti() && this->Get<float>(Slope) == 0.0f && intercept != 0.0f && std::isfinite(intercept))
  {
    return "its header has an intercept of " + FormatReal(intercept) +
           ", but a slope of 0, which programs take in different ways; set scl_slope to 1 or scl_inter to 0";
  }
  return {};
}

NiftiHeader::Matrix
NiftiHeader::GetQuaternionMatrix() const
{
  const double b = this->Get<float>(Quaternion);
  const double c = this->Get<float>(Quaternion + 4);
  const double d = this->Get<float>(Quaternion + 8);
  const double a = std::sqrt(std::max(0.0, 1.0 - b * b - c * c - d * d));
  const Matrix turn = { { { a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c), 0 },
                          { 2 * (b * c + a * d), a * a + c * c - b * b - d * d, 2 * (c * d - a * b), 0 },
                          { 2 * (b * d - a * c), 2 * (c * d + a * b), a * a + d * d - b * b - c * c, 0 } } };
  Matrix       matrix = turn;
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double sign = axis == 2 && this->Get<float>(Spacings) < 0 ? -1.0 : 1.0;
      matrix[row][axis] *= sign * this->Get<float>(Spacings + 4 * (axis + 1));
    }
    matrix[row][3] = this->Get<float>(Offsets + 4 * row);
  }
  return matrix;
}

NiftiHeader::Matrix
NiftiHeader::GetMatrix() const
{
  Matrix matrix;
  for (std::size_t i = 0; i < 12; ++i)
  {
    matrix[i / 4][i % 4] = this->Get<float>(Rows + 4 * i);
  }
  return matrix;
}

bool
NiftiHeader::IsPlacedFinitely() const
{
  const auto areFinite = [this](std::size_t place, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!std::isfinite(this->Get<float>(place + 4 * i)))
      {
        return false;
      }
    }
    return true;
  };
  constexpr std::size_t quaternionNumbers = 6; // with the offsets after it
  constexpr std::size_t matrixNumbers = 12;
  return !this->IsPlaced() ||
         ((this->Get<std::int16_t>(QuaternionCode) <= 0 || areFinite(Quaternion, quaternionNumbers)) &&
          (this->Get<std::int16_t>(MatrixCode) <= 0 || areFinite(Rows, matrixNumbers)));
}

bool
NiftiHeader::IsPlaced() const
{
  return this->IsNifti() && (this->Get<std::int16_t>(QuaternionCode) > 0 || this->Get<std::int16_t>(MatrixCode) > 0);
}

bool
NiftiHeader::IsPlacedTwice() const
{
  if (!this->IsNifti() || this->Get<std::int16_t>(QuaternionCode) <= 0 || this->Get<std::int16_t>(MatrixCode) <= 0)
  {
    return false;
  }
  const Matrix a = this->GetQuaternionMatrix();
  const Matrix b = this->GetMatrix();
  double       smallest = 1e30;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    smallest = std::min<double>(smallest, std::abs(this->Get<float>(Spacings + 4 * (axis + 1))));
  }
  // Both are in single precision, and rounded on the way: a tenth of a voxel is no rounding.
  double largest = 0.0;
  for (std::size_t row = 0; row < 3; ++row)
  {
    double change = std::abs(a[row][3] - b[row][3]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double count = this->Get<std::uint16_t>(Dimensions + 2 * (axis + 1));
      change = std::max(change, std::abs(a[row][axis] - b[row][axis]) * count);
    }
    largest = std::max(largest, change);
  }
  return largest > 0.1 * smallest;
}

const char *
NiftiHeader::GetPlacement(const ImageGrid & grid) const
{
  // The grid is in millimetres, in a space whose first two axes point the other way.
  const double millimetres = grid.Spacing[0] / std::abs(this->Get<float>(Spacings + 4));
  const auto   getDistance = [&](const Matrix & matrix) {
    double distance = 0.0;
    for (std::size_t row = 0; row < 3 && row < grid.Origin.size(); ++row)
    {
      const double sign = row < 2 ? -1.0 : 1.0;
      distance += std::abs(sign * millimetres * matrix[row][3] - grid.Origin[row]);
      for (std::size_t axis = 0; axis < 3 && axis < grid.Size.size(); ++axis)
      {
        distance += std::abs(sign * millimetres * matrix[row][axis] - grid.Spacing[axis] * grid.Directions[axis][row]);
      }
    }
    return distance;
  };
  return getDistance(this->GetMatrix()) < getDistance(this->GetQuaternionMatrix()) ? "sform" : "qform";
}

bool
IsNiftiHeader(const std::string & path)
{
  const NiftiHeader header(path);
  return header.IsSingleFile() || header.IsOfPair() || header.IsOfVersion2();
}

NiftiHeader
ReadNiftiHeader(const std::string & path)
{
  return NiftiHeader(IsNiftiPair(path) ? FindNiftiPair(path).Header : path);
}
