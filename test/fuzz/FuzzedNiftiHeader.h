// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzedNiftiHeader_h
#define FuzzedNiftiHeader_h

#include "volumes/ImageDescription.h"

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

/** What the header says of a type of voxels. */
struct FuzzedNiftiType
{
  int                           Code;
  itk::Subdivision::ElementType Component;
  unsigned                      Components;
  VoxelKind                     Kind;
};

/** The header of NIfTI, number by number, by the places that the format's definition says. */
struct FuzzedNiftiHeader
{
  static constexpr std::size_t Size = 348;

  explicit FuzzedNiftiHeader(const std::string & text);

  unsigned
  Short(std::size_t place) const;

  float
  Real(std::size_t place) const;

  /** \return nullptr for a type that is none of those that are read here */
  const FuzzedNiftiType *
  FindType() const;

  /** Whether it is NIfTI's, and whether the voxels follow in the same file; else it is Analyze's, or nobody's. */
  bool
  IsSingle() const
  {
    return Text.substr(344, 4) == std::string("n+1\0", 4);
  }
  bool
  IsNifti() const
  {
    return this->IsSingle() || Text.substr(344, 4) == std::string("ni1\0", 4);
  }

  /** Bytes before the voxels and of them, as real numbers, which do not overflow. */
  double
  GetOffset() const;
  double
  GetVoxelBytes() const;

  /** Slope and intercept, where there are any that change something. */
  std::optional<std::pair<double, double>>
  GetRescaling() const;

  std::string Text;
  bool        IsWhole = false;
  bool        IsBig = false;
  bool        IsSane = false; // whole, and with a number of axes in one of the byte orders
};

/** The bits of a number as it stands in a file. */
std::uint64_t
GetBits(const std::string & text, bool isBig, std::size_t place, std::size_t size);

template <typename T>
T
FromBits(const std::uint64_t bits)
{
  using Bits = std::conditional_t<sizeof(T) == 1,
                                  std::uint8_t,
                                  std::conditional_t<sizeof(T) == 2,
                                                     std::uint16_t,
                                                     std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;
  const auto low = static_cast<Bits>(bits);
  T          number;
  std::memcpy(&number, &low, sizeof(number));
  return number;
}

#endif
