// SPDX-License-Identifier: Apache-2.0
#ifndef ConversionsPortable_h
#define ConversionsPortable_h

// Conversions of rows of elements from and to real values, in plain C++.

#include "kernel/vectors/RoundToElement.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

template <typename TElement, typename T>
void
WidenElements(const TElement * in, std::size_t count, T * out)
{
  for (std::size_t x = 0; x < count; ++x)
  {
    out[x] = static_cast<T>(in[x]);
  }
}

/** RoundToElement() in a way that compilers make vectors of, where there is one. */
template <typename TElement, typename T>
inline TElement
RoundValue(const T value)
{
  if constexpr (std::is_same<T, float>::value && std::is_integral<TElement>::value && sizeof(TElement) <= 2)
  {
    constexpr float lowest = std::numeric_limits<TElement>::lowest();
    constexpr float largest = std::numeric_limits<TElement>::max();
    // Adding this moves the binary point to the end of the mantissa.
    constexpr float integersOnly = 12582912.0f;
    const float     number = value == value ? value : 0.0f;
    const float     bounded = number < lowest ? lowest : (number > largest ? largest : number);
    return static_cast<TElement>(static_cast<std::int32_t>((bounded + integersOnly) - integersOnly));
  }
  else
  {
    return RoundToElement<TElement>(value);
  }
}

/** Elements of values that are in order. */
template <typename T, typename TElement>
void
NarrowValues(const T * values, std::size_t count, TElement * out)
{
  for (std::size_t x = 0; x < count; ++x)
  {
    out[x] = RoundValue<TElement>(values[x]);
  }
}

/** Elements, in order, of both children of \c count voxels along x. Vectors of a single lane are in order. */
template <typename T, typename TElement>
void
InterleaveChildren(const T * children, std::size_t count, TElement * out)
{
  NarrowValues(children, 2 * count, out);
}

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk

#endif
