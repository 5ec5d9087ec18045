// SPDX-License-Identifier: Apache-2.0
// Scalar images of one to four dimensions against the slow reference.

#include "SubdivisionCommonFilters.h"
#include "SubdivisionRandomCases.h"

using namespace SubdivisionTest;

TEST(NonOscillatorySubdivisionRandom, OneDimension)
{
  CompareWithReference<Line>(100, -1.0, 1.0);
  CompareWithReference<itk::Image<unsigned char, 1>>(60, 0.0, 255.0);
}

TEST(NonOscillatorySubdivisionRandom, TwoDimensions)
{
  CompareWithReference<itk::Image<float, 2>>(60, -1.0, 1.0);
  CompareWithReference<itk::Image<short, 2>>(60, -1024.0, 3071.0);
}

TEST(NonOscillatorySubdivisionRandom, ThreeDimensionsDouble) { CompareWithReference<DoubleImage>(60, -1.0, 1.0); }

TEST(NonOscillatorySubdivisionRandom, ThreeDimensionsFloat) { CompareWithReference<FloatImage>(60, -1000.0, 1000.0); }

TEST(NonOscillatorySubdivisionRandom, ThreeDimensionsUnsignedShort)
{
  CompareWithReference<UShortImage>(60, 0.0, 65535.0);
}

TEST(NonOscillatorySubdivisionRandom, FourDimensions)
{
  CompareWithReference<itk::Image<short, 4>>(40, -1024.0, 3071.0);
}
