// SPDX-License-Identifier: Apache-2.0
#ifndef ImageFidelityDefinitions_h
#define ImageFidelityDefinitions_h

#include "itkImageRegionConstIteratorWithIndex.h"

#include <algorithm>
#include <cmath>
#include <vector>

inline double
GetQuantileOfSorted(const std::vector<double> & sorted, double level)
{
  const double position = level * static_cast<double>(sorted.size() - 1);
  const auto   below = static_cast<std::size_t>(std::floor(position));
  const auto   above = static_cast<std::size_t>(std::ceil(position));
  return sorted[below] == sorted[above]
           ? sorted[below]
           : sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/** The definitions of the figures, written down voxel by voxel: what the calculator is compared with. */
template <typename TReference, typename TTest>
struct ImageFidelityDefinitions
{
  static constexpr unsigned int Dimension = TReference::ImageDimension;
  using IndexType = typename TReference::IndexType;

  const TReference *  reference;
  const TTest *       test;
  bool                useSpacing{ false };
  std::vector<double> errors{};
  long double         squaredError{ 0 };
  long double         squaredReference{ 0 };
  long double         referenceTotalVariation{ 0 };
  long double         testTotalVariation{ 0 };

  bool
  IsCompared(const IndexType & index) const
  {
    return reference->GetLargestPossibleRegion().IsInside(index) &&
           std::isfinite(static_cast<double>(reference->GetPixel(index))) &&
           std::isfinite(static_cast<double>(test->GetPixel(index)));
  }

  template <typename TImage>
  long double
  GetGradientNorm(const TImage * image, const IndexType & index) const
  {
    long double sum = 0;
    long double volume = 1;
    for (unsigned int axis = 0; axis < Dimension; ++axis)
    {
      IndexType next = index;
      next[axis] += 1;
      const long double spacing = useSpacing ? image->GetSpacing()[axis] : 1.0;
      volume *= spacing;
      if (this->IsCompared(index) && this->IsCompared(next))
      {
        const long double quotient =
          (static_cast<long double>(image->GetPixel(next)) - static_cast<long double>(image->GetPixel(index))) /
          spacing;
        sum += quotient * quotient;
      }
    }
    return std::sqrt(sum) * volume;
  }

  void
  Evaluate()
  {
    itk::ImageRegionConstIteratorWithIndex<TReference> it(reference, reference->GetLargestPossibleRegion());
    for (; !it.IsAtEnd(); ++it)
    {
      const IndexType index = it.GetIndex();
      referenceTotalVariation += this->GetGradientNorm(reference, index);
      testTotalVariation += this->GetGradientNorm(test, index);
      if (this->IsCompared(index))
      {
        const double r = static_cast<double>(reference->GetPixel(index));
        const double t = static_cast<double>(test->GetPixel(index));
        errors.push_back(std::abs(t - r));
        squaredError += static_cast<long double>(t - r) * (t - r);
        squaredReference += static_cast<long double>(r) * r;
      }
    }
    std::sort(errors.begin(), errors.end());
  }
};

#endif
