// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionPixelTraits_h
#define itkSubdivisionPixelTraits_h

#include "itkNumericTraits.h"
#include "itkSubdivisionKernel.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace itk
{

/** The type of one component of an image's pixels. */
template <typename TImage>
using SubdivisionComponentType = typename NumericTraits<typename TImage::PixelType>::ValueType;

/** Whether a component needs double: 16 bits and less are exact in float. */
template <typename TComponent>
constexpr bool SubdivisionNeedsDouble =
  std::is_same<TComponent, double>::value || std::is_same<TComponent, long double>::value ||
  (std::is_integral<TComponent>::value && sizeof(TComponent) > 2);

/** The type of the computation from one image to another. */
template <typename TInputImage, typename TOutputImage>
using SubdivisionRealType = typename std::conditional<SubdivisionNeedsDouble<SubdivisionComponentType<TInputImage>> ||
                                                        SubdivisionNeedsDouble<SubdivisionComponentType<TOutputImage>>,
                                                      double,
                                                      float>::type;

/** The type of the same size that the kernel converts in vector code, or void. */
template <typename TComponent>
using SubdivisionVectorPixelType = typename std::conditional<
  std::is_same<TComponent, float>::value,
  float,
  typename std::conditional<
    !std::is_integral<TComponent>::value || std::is_same<TComponent, bool>::value || (sizeof(TComponent) > 2),
    void,
    typename std::conditional<
      sizeof(TComponent) == 1,
      typename std::conditional<std::is_signed<TComponent>::value, std::int8_t, std::uint8_t>::type,
      typename std::conditional<std::is_signed<TComponent>::value, std::int16_t, std::uint16_t>::type>::type>::type>::
  type;

/** A real value as a component of a pixel: integers round to nearest, ties to even, and saturate, and NaN becomes 0;
 * real values are passed on. */
template <typename TComponent, typename TReal>
inline TComponent
SubdivisionRound(const TReal value)
{
  if constexpr (std::is_floating_point<TComponent>::value)
  {
    return static_cast<TComponent>(value);
  }
  else if constexpr (std::is_same<TComponent, bool>::value)
  {
    return value > TReal(0.5);
  }
  else
  {
    using Limits = std::numeric_limits<TComponent>;
    if (!(value == value))
    {
      return TComponent{ 0 };
    }
    if (value <= static_cast<TReal>(Limits::lowest()))
    {
      return Limits::lowest();
    }
    // The largest 64-bit integer is not a double; what reaches the next one saturates.
    if (value >= static_cast<TReal>(Limits::max()))
    {
      return Limits::max();
    }
    return static_cast<TComponent>(std::nearbyint(value));
  }
}

} // namespace itk

#endif
