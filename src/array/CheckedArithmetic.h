// SPDX-License-Identifier: Apache-2.0
#ifndef CheckedArithmetic_h
#define CheckedArithmetic_h

#include "NonOscillatorySubdivision/ArrayView.h"

#include <cstdint>
#include <limits>
#include <stdexcept>

namespace itk
{
namespace Subdivision
{

// Sums and products of 64-bit integers that throw std::overflow_error where they do not fit.

[[noreturn]] inline void
ThrowOverflow()
{
  throw std::overflow_error("an index or a size does not fit 64 bits");
}

inline std::int64_t
CheckedAdd(const std::int64_t a, const std::int64_t b)
{
  using Limits = std::numeric_limits<std::int64_t>;
  if (b > 0 ? a > Limits::max() - b : a < Limits::min() - b)
  {
    ThrowOverflow();
  }
  return a + b;
}

inline std::int64_t
CheckedSubtract(const std::int64_t a, const std::int64_t b)
{
  using Limits = std::numeric_limits<std::int64_t>;
  if (b > 0 ? a < Limits::min() + b : a > Limits::max() + b)
  {
    ThrowOverflow();
  }
  return a - b;
}

inline std::uint64_t
CheckedMultiply(const std::uint64_t a, const std::uint64_t b)
{
  if (b != 0 && a > std::numeric_limits<std::uint64_t>::max() / b)
  {
    ThrowOverflow();
  }
  return a * b;
}

/** A size as a difference of indices. */
inline std::int64_t
CheckedSigned(const std::uint64_t size)
{
  if (size > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
  {
    ThrowOverflow();
  }
  return static_cast<std::int64_t>(size);
}

/** The last index of an interval that is not empty. */
inline std::int64_t
GetLast(const Interval & interval)
{
  return CheckedAdd(interval.First, CheckedSigned(interval.Size) - 1);
}

/** The interval of two indices and what lies between them. */
inline Interval
MakeInterval(const std::int64_t first, const std::int64_t last)
{
  return { first, static_cast<std::uint64_t>(CheckedAdd(CheckedSubtract(last, first), 1)) };
}

} // namespace Subdivision
} // namespace itk

#endif
