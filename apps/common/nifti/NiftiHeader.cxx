// SPDX-License-Identifier: Apache-2.0
#include "nifti/NiftiHeader.h"
#include "nifti/NiftiFiles.h"
#include "text/HeaderText.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

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
constexpr std::size_t Quaternion = 256; // and the offsets
constexpr std::size_t SpmOrigin = 253;  // of Analyze alone, which has a text there otherwise
constexpr std::size_t Rows = 280;
constexpr std::size_t Magic = 344;

/** Types of voxels that are not one number of a type of C++. */
constexpr int Complex64 = 32;
constexpr int Rgb24 = 128;
constexpr int Complex128 = 1792;
constexpr int Rgba32 = 2304;

/** Intents of voxels of several components: symmetric matrices, displacements, vectors. */
constexpr int SymmetricMatrices = 1005;
constexpr int Displacements = 1006;
constexpr int Vectors = 1007;

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

/** Whether so many components are those of a symmetric matrix without those that are there twice. */
bool
AreOfSymmetricMatrix(int components)
{
  int rest = components;
  for (int row = 1; rest > 0; ++row)
  {
    rest -= row;
  }
  return rest == 0;
}

/** Whether single precision holds what numbers become by a slope and an intercept, if it is to: doubles stay such. */
bool
FitsSinglePrecision(const std::pair<double, double> & rescaling, itk::Subdivision::ElementType type)
{
  const double slope = std::abs(rescaling.first);
  const double largest = itk::Subdivision::WithElementType(type, [](auto tag) {
    using Type = typename decltype(tag)::Type;
    return std::is_integral_v<Type> ? static_cast<double>(std::numeric_limits<Type>::max()) : 1.0;
  });
  const bool   isTooSmall = slope < std::numeric_limits<float>::min();
  const bool   isTooLarge = largest * slope + std::abs(rescaling.second) > std::numeric_limits<float>::max();
  const bool   isFinite = std::isfinite(slope) && std::isfinite(rescaling.second);
  return type == itk::Subdivision::ElementType::Double || !isFinite || !(isTooSmall || isTooLarge);
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
  return this->Get<std::int16_t>(Intent) == Displacements;
}

std::optional<std::pair<double, double>>
NiftiHeader::GetRescaling() const
{
  const double stored = this->Get<float>(Slope);
  const double slope = stored == 0.0 ? 1.0 : stored;
  const double intercept = this->Get<float>(Intercept);
  // What is not a number is how some programs write that there is none.
  const bool changes = slope < 1.0 || slope > 1.0 || intercept < 0.0 || intercept > 0.0;
  // Analyze has no slope there.
  return this->IsNifti() && changes ? std::make_optional(std::make_pair(slope, intercept)) : std::nullopt;
}

bool
NiftiHeader::IsRescaledByItk() const
{
  constexpr double least = std::numeric_limits<double>::epsilon();
  const auto       rescaling = this->GetRescaling();
  return !rescaling || (std::abs(rescaling->first) > least &&
                        (std::abs(rescaling->first - 1.0) > least || std::abs(rescaling->second) > least));
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
    grid.Origin[3] = this->GetPlacement().IsThere() && std::isfinite(start) ? start * GetSeconds(units) : 0.0;
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
  const std::string fault = this->FindComponentFault();
  if (!fault.empty())
  {
    return fault;
  }
  const auto rescaling = this->GetRescaling();
  if (rescaling && component && !FitsSinglePrecision(*rescaling, *component))
  {
    return "its slope and intercept (scl_slope, scl_inter) make numbers that are too small or too large for single "
           "precision; save them in another unit";
  }
  return {};
}

std::string
NiftiHeader::FindComponentFault() const
{
  const int intent = this->Get<std::int16_t>(Intent);
  if (!this->IsNifti() || intent < SymmetricMatrices || intent > Vectors)
  {
    return {};
  }
  const std::string which = " (intent_code " + std::to_string(intent) + ")";
  if (this->CountComponentsSideBySide() > 1)
  {
    return "its header says that its voxels are vectors or matrices" + which +
           " of complex numbers or colours (datatype), which are not supported; set intent_code to 0 if each voxel is "
           "one of these";
  }
  const int axes = this->Get<std::int16_t>(Dimensions);
  if ((axes >= 6 && this->Get<std::int16_t>(Dimensions + 12) != 1) ||
      (axes >= 7 && this->Get<std::int16_t>(Dimensions + 14) != 1))
  {
    return "its header says that its voxels are vectors or matrices" + which + ", but it has " + std::to_string(axes) +
           " axes; up to 4, and a fifth for the components, are supported";
  }
  const int components = axes >= 5 ? this->Get<std::int16_t>(Dimensions + 10) : 1;
  if (intent == SymmetricMatrices && !AreOfSymmetricMatrix(components))
  {
    return "its header says that its voxels are symmetric matrices" + which + ", but " + std::to_string(components) +
           " components are none; set intent_code to 1007 if they are vectors";
  }
  return {};
}

std::string
NiftiHeader::FindSpmParts() const
{
  if (this->IsNifti() || !this->IsOfPair())
  {
    return {};
  }
  const float scale = std::abs(this->Get<float>(Slope)); // SPM puts it there, too
  const bool  isScaled = scale > 1e-30f && scale < 1e30f && scale != 1.0f;
  bool        hasOrigin = true;
  for (std::size_t axis = 0; axis < 3; ++axis) // the number of a voxel; a text would be larger numbers
  {
    const auto origin = this->Get<std::int16_t>(SpmOrigin + 2 * axis);
    hasOrigin = hasOrigin && origin >= 1 && origin <= this->Get<std::int16_t>(Dimensions + 2 * (axis + 1));
  }
  const std::string factor = isScaled ? "a scale factor of " + FormatReal(this->Get<float>(Slope)) : std::string();
  return factor + (isScaled && hasOrigin ? " and " : "") + (hasOrigin ? "an origin" : "");
}

NiftiPlacement
NiftiHeader::GetPlacement() const
{
  NiftiPlacement::Numbers numbers;
  numbers.HasQuaternion = this->IsNifti() && this->Get<std::int16_t>(QuaternionCode) > 0;
  numbers.HasMatrix = this->IsNifti() && this->Get<std::int16_t>(MatrixCode) > 0;
  for (std::size_t i = 0; i < numbers.Quaternion.size(); ++i)
  {
    numbers.Quaternion[i] = this->Get<float>(Quaternion + 4 * i);
  }
  for (std::size_t i = 0; i < 12; ++i)
  {
    numbers.Rows[i / 4][i % 4] = this->Get<float>(Rows + 4 * i);
  }
  numbers.Axes = std::clamp<int>(this->Get<std::int16_t>(Dimensions), 1, 3);
  numbers.Sign = this->Get<float>(Spacings) < 0 ? -1.0 : 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    numbers.Spacing[axis] = this->Get<float>(Spacings + 4 * (axis + 1));
    numbers.Size[axis] = this->Get<std::uint16_t>(Dimensions + 2 * (axis + 1));
  }
  return NiftiPlacement(numbers);
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
