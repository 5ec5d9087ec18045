// SPDX-License-Identifier: Apache-2.0

// The table of what one target offers. No include guard: every target includes this file once, into its own namespace.

#include "itkSubdivisionPlanes-inl.h"

namespace itk
{
namespace SUBDIVISION_TARGET
{

template <typename T>
constexpr SubdivisionSweepSteps<T>
SweepSteps()
{
  return { &AdvancePlane<T>, &ComputeRow<T>, &ComputeChildren<T> };
}

template <typename TPixel>
constexpr SubdivisionConversion<TPixel>
Conversion()
{
  return { &ConvertRow<TPixel>, &InterleaveChildren<float, TPixel> };
}

constexpr SubdivisionTarget
MakeTarget(const char * name)
{
  return { name,
           SweepSteps<float>(),
           SweepSteps<double>(),
           Conversion<std::uint8_t>(),
           Conversion<std::int8_t>(),
           Conversion<std::uint16_t>(),
           Conversion<std::int16_t>(),
           Conversion<float>(),
           &InterleaveChildren<double, double> };
}

} // namespace SUBDIVISION_TARGET
} // namespace itk
