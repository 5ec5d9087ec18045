// SPDX-License-Identifier: Apache-2.0
#include "array/Losses.h"

#include <cstdint>
#include <limits>
#include <type_traits>

namespace itk
{
namespace Subdivision
{
namespace
{

template <typename T>
bool
HasAny(const T * const elements, const std::size_t count, const T first, const T second, const T third)
{
  // As wide as the elements, so that compilers vectorise the loop.
  T found = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const T element = elements[i];
    found |= static_cast<T>(element == first) | static_cast<T>(element == second) | static_cast<T>(element == third);
  }
  return found != 0;
}

} // namespace

bool
MayHaveLost(const ElementType integers, const void * const elements, const std::size_t count, const bool zeroMayBeNaN)
{
  return WithElementType(integers, [=](auto tag) {
    using Type = typename decltype(tag)::Type;
    if constexpr (std::is_integral<Type>::value)
    {
      using Limits = std::numeric_limits<Type>;
      const Type least = Limits::lowest();
      return HasAny(static_cast<const Type *>(elements), count, least, Limits::max(), zeroMayBeNaN ? Type{ 0 } : least);
    }
    else
    {
      return false;
    }
  });
}

template <typename TReal>
Losses
CountLosses(const ElementType integers, const TReal * const values, const std::size_t count)
{
  return WithElementType(integers, [=](auto tag) {
    using Limits = std::numeric_limits<typename decltype(tag)::Type>;
    // As wide as the values, so that compilers vectorise the loop; rows are shorter than what it counts to.
    using Counter = std::conditional_t<sizeof(TReal) == sizeof(float), std::int32_t, std::int64_t>;
    // One half beyond the least number, which is even, is rounded to it; one half beyond the greatest, which is odd, to
    // what is out of range. Where a half is too small for the real type, the limit is a power of two.
    const auto below = static_cast<TReal>(static_cast<double>(Limits::lowest()) - 0.5);
    const auto from = static_cast<TReal>(static_cast<double>(Limits::max()) + 0.5);
    Counter    notANumber = 0;
    Counter    clamped = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const TReal value = values[i];
      notANumber += value != value;
      clamped += (value < below) + (value >= from);
    }
    return Losses{ static_cast<std::size_t>(notANumber), static_cast<std::size_t>(clamped) };
  });
}

template Losses
CountLosses<float>(ElementType, const float *, std::size_t);
template Losses
CountLosses<double>(ElementType, const double *, std::size_t);

} // namespace Subdivision
} // namespace itk
