// SPDX-License-Identifier: Apache-2.0
#include "FuzzedNiftiHeader.h"
#include "FuzzedFiles.h"

#include <algorithm>
#include <cmath>

using itk::Subdivision::ElementType;

namespace
{
constexpr FuzzedNiftiType Types[] = {
  { 2, ElementType::UInt8, 1, VoxelKind::Scalar },      { 4, ElementType::Int16, 1, VoxelKind::Scalar },
  { 8, ElementType::Int32, 1, VoxelKind::Scalar },      { 16, ElementType::Float, 1, VoxelKind::Scalar },
  { 32, ElementType::Float, 2, VoxelKind::Complex },    { 64, ElementType::Double, 1, VoxelKind::Scalar },
  { 128, ElementType::UInt8, 3, VoxelKind::Rgb },       { 256, ElementType::Int8, 1, VoxelKind::Scalar },
  { 512, ElementType::UInt16, 1, VoxelKind::Scalar },   { 768, ElementType::UInt32, 1, VoxelKind::Scalar },
  { 1024, ElementType::Int64, 1, VoxelKind::Scalar },   { 1280, ElementType::UInt64, 1, VoxelKind::Scalar },
  { 1792, ElementType::Double, 2, VoxelKind::Complex }, { 2304, ElementType::UInt8, 4, VoxelKind::Rgba }
};
} // namespace

FuzzedNiftiHeader::FuzzedNiftiHeader(const std::string & text)
  : Text(text)
  , IsWhole(text.size() >= Size)
{
  Text.resize(Size);
  const auto isCount = [](std::uint64_t number) { return number >= 1 && number <= 7; };
  IsBig = isCount(GetBits(Text, true, 40, 2));
  IsSane = IsWhole && (IsBig || isCount(GetBits(Text, false, 40, 2)));
}

unsigned
FuzzedNiftiHeader::Short(const std::size_t place) const
{
  return static_cast<unsigned>(GetBits(Text, IsBig, place, 2));
}

float
FuzzedNiftiHeader::Real(const std::size_t place) const
{
  return FromBits<float>(GetBits(Text, IsBig, place, 4));
}

const FuzzedNiftiType *
FuzzedNiftiHeader::FindType() const
{
  const auto * const found = std::find_if(std::begin(Types), std::end(Types), [&](const FuzzedNiftiType & type) {
    return type.Code == static_cast<int>(this->Short(70));
  });
  return found == std::end(Types) ? nullptr : found;
}

double
FuzzedNiftiHeader::GetOffset() const
{
  const float offset = this->Real(108);
  return offset >= 0.0f && offset < 1e15f ? std::floor(static_cast<double>(offset)) : 0.0;
}

double
FuzzedNiftiHeader::GetVoxelBytes() const
{
  double bits = this->Short(72);
  for (unsigned axis = 1; axis <= this->Short(40); ++axis)
  {
    bits *= this->Short(40 + 2 * axis);
  }
  return std::floor(bits / 8.0);
}

std::optional<std::pair<double, double>>
FuzzedNiftiHeader::GetRescaling() const
{
  const double stored = this->Real(112);
  const double slope = std::isnan(stored) || stored == 0.0 ? 1.0 : stored;
  const double intercept = std::isnan(this->Real(116)) ? 0.0 : this->Real(116);
  return this->IsNifti() && (slope != 1.0 || intercept != 0.0) ? std::make_optional(std::make_pair(slope, intercept))
                                                               : std::nullopt;
}

/** A number as it stands in a file. */
std::uint64_t
GetBits(const std::string & text, const bool isBig, const std::size_t place, const std::size_t size)
{
  const std::string number = text.substr(place, size);
  return GetLittleEndian(isBig ? std::string(number.rbegin(), number.rend()) : number, 0, size);
}
