// SPDX-License-Identifier: Apache-2.0
#ifndef itkImageFidelitySums_h
#define itkImageFidelitySums_h

#include "itkIntTypes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

// What ImageFidelityCalculator adds up, row by row.

namespace itk
{
namespace Detail
{

/** What is known of one image, or of some rows of it. */
struct ImageFidelityImageSummary
{
  double totalVariation{ 0.0 };
  double minimum{ std::numeric_limits<double>::infinity() };
  double maximum{ -std::numeric_limits<double>::infinity() };

  void
  AddToRange(const double value)
  {
    minimum = std::min(minimum, value);
    maximum = std::max(maximum, value);
  }

  void
  Append(const ImageFidelityImageSummary & other)
  {
    totalVariation += other.totalVariation;
    minimum = std::min(minimum, other.minimum);
    maximum = std::max(maximum, other.maximum);
  }
};

/** What the first pass finds out about one row, or about several. */
struct ImageFidelityRowSummary
{
  ImageFidelityImageSummary reference{};
  ImageFidelityImageSummary test{};
  double                    squaredError{ 0.0 };
  double                    squaredReference{ 0.0 };
  SizeValueType             numberOfComparedVoxels{ 0 };

  void
  AddVoxel(const double referenceValue, const double testValue)
  {
    ++numberOfComparedVoxels;
    squaredError += (testValue - referenceValue) * (testValue - referenceValue);
    squaredReference += referenceValue * referenceValue;
    reference.AddToRange(referenceValue);
    test.AddToRange(testValue);
  }

  void
  Append(const ImageFidelityRowSummary & other)
  {
    reference.Append(other.reference);
    test.Append(other.test);
    squaredError += other.squaredError;
    squaredReference += other.squaredReference;
    numberOfComparedVoxels += other.numberOfComparedVoxels;
  }
};

/** Adds the weighted and squared differences from the first values of a row to those of the next one; one from or to
 * NaN counts as zero. */
inline void
AddSquaredDifferences(const std::vector<double> & row,
                      const double *              next,
                      const SizeValueType         length,
                      const double                weight,
                      std::vector<double> &       sums)
{
  for (SizeValueType i = 0; i < length; ++i)
  {
    const double difference = (next[i] - row[i]) * weight;
    sums[i] += std::isnan(difference) ? 0.0 : difference * difference;
  }
}

inline double
SumOfRoots(const std::vector<double> & squares)
{
  double sum = 0.0;
  for (const double square : squares)
  {
    sum += std::sqrt(square);
  }
  return sum;
}

} // namespace Detail
} // namespace itk

#endif
