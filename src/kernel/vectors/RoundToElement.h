// SPDX-License-Identifier: Apache-2.0
#ifndef RoundToElement_h
#define RoundToElement_h

#include <cstdint>
#include <limits>
#include <type_traits>

namespace itk
{
namespace Subdivision
{

/** The integer next to a value below 2^63 in magnitude, ties to even, whatever the caller's rounding mode is. */
inline std::int64_t
RoundToEven(const double value)
{
  const auto   truncated = static_cast<std::int64_t>(value);
  const double rest = value - static_cast<double>(truncated);
  if (rest > 0.5 || (rest == 0.5 && truncated % 2 != 0))
  {
    return truncated + 1;
  }
  if (rest < -0.5 || (rest == -0.5 && truncated % 2 != 0))
  {
    return truncated - 1;
  }
  return truncated;
}

/** An element: integers round to nearest, ties to even, and saturate; NaN becomes 0. Real values are neither rounded
 * nor clamped. */
template <typename TElement, typename T>
inline TElement
RoundToElement(const T value)
{
  if constexpr (std::is_floating_point<TElement>::value)
  {
    return static_cast<TElement>(value);
  }
  else
  {
    using Limits = std::numeric_limits<TElement>;
    // 2^bits: the first value that does not fit, which the largest one of 64 bits is not as a real value.
    constexpr double beyond = 2.0 * static_cast<double>(Limits::max() / 2 + 1);
    const double     number = static_cast<double>(value);
    if (number != number)
    {
      return 0;
    }
    if (number >= beyond)
    {
      return Limits::max();
    }
    if (number <= static_cast<double>(Limits::lowest()))
    {
      return Limits::lowest();
    }
    if constexpr (std::is_same<TElement, std::uint64_t>::value)
    {
      constexpr double integersOnly = 9007199254740992.0;
      return number >= integersOnly ? static_cast<TElement>(number) : static_cast<TElement>(RoundToEven(number));
    }
    else
    {
      const std::int64_t rounded = RoundToEven(number);
      return rounded > static_cast<std::int64_t>(Limits::max()) ? Limits::max() : static_cast<TElement>(rounded);
    }
  }
}

} // namespace Subdivision
} // namespace itk

#endif
