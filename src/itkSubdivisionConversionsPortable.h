// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionConversionsPortable_h
#define itkSubdivisionConversionsPortable_h

// Conversions of rows of pixels from and to float, in plain C++.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace itk
{
namespace SUBDIVISION_TARGET
{

template <typename TPixel>
void
ConvertRow(const TPixel * in, std::size_t count, float * out)
{
  for (std::size_t x = 0; x < count; ++x)
  {
    out[x] = static_cast<float>(in[x]);
  }
}

/** A pixel: integers round to nearest, ties to even, and saturate; NaN becomes 0. */
template <typename TPixel, typename T>
inline TPixel
RoundToPixel(T value)
{
  if constexpr (std::is_floating_point<TPixel>::value)
  {
    return value;
  }
  else
  {
    constexpr float lowest = std::numeric_limits<TPixel>::lowest();
    constexpr float largest = std::numeric_limits<TPixel>::max();
    // Adding this moves the binary point to the end of the mantissa.
    constexpr float integersOnly = 12582912.0f;
    const float     number = value == value ? value : 0.0f;
    const float     bounded = number < lowest ? lowest : (number > largest ? largest : number);
    return static_cast<TPixel>(static_cast<std::int32_t>((bounded + integersOnly) - integersOnly));
  }
}

template <typename T, typename TPixel>
void
InterleaveChildren(const T * children, std::size_t count, TPixel * out)
{
  // Vectors of a single lane are in order.
  for (std::size_t x = 0; x < 2 * count; ++x)
  {
    out[x] = RoundToPixel<TPixel>(children[x]);
  }
}

} // namespace SUBDIVISION_TARGET
} // namespace itk

#endif
