// SPDX-License-Identifier: Apache-2.0
// Other pixel types against the slow reference: further integers, several components, and an output type that differs
// from the input's.

#include "SubdivisionRandomCases.h"

#include "itkRGBPixel.h"
#include "itkVector.h"

using namespace SubdivisionTest;

TEST(NonOscillatorySubdivisionPixels, SignedChar)
{
  CompareWithReference<itk::Image<signed char, 2>>(30, -128.0, 127.0);
}

TEST(NonOscillatorySubdivisionPixels, Int)
{
  CompareWithReference<itk::Image<int, 2>>(30, -2147483647.0, 2147483647.0);
}

TEST(NonOscillatorySubdivisionPixels, UnsignedLongLong)
{
  // Up to 2^48, so that the reference tells neighbouring integers apart.
  CompareWithReference<itk::Image<unsigned long long, 1>>(30, 0.0, 281474976710656.0);
}

TEST(NonOscillatorySubdivisionPixels, Vector)
{
  CompareWithReference<itk::Image<itk::Vector<float, 2>, 2>>(30, -1.0, 1.0, 2);
}

TEST(NonOscillatorySubdivisionPixels, RGB)
{
  CompareWithReference<itk::Image<itk::RGBPixel<unsigned char>, 3>>(20, 0.0, 255.0, 3);
}

TEST(NonOscillatorySubdivisionPixels, VectorImage)
{
  CompareWithReference<itk::VectorImage<short, 3>>(20, -1024.0, 3071.0, 4);
}

TEST(NonOscillatorySubdivisionPixels, VectorImageOfOneComponent)
{
  CompareWithReference<itk::VectorImage<double, 2>>(20, -1.0, 1.0, 1);
}

TEST(NonOscillatorySubdivisionPixels, IntegerToReal)
{
  CompareWithReference<itk::Image<unsigned char, 2>, itk::Image<float, 2>>(30, 0.0, 255.0);
}

TEST(NonOscillatorySubdivisionPixels, DoubleToUnsignedChar)
{
  CompareWithReference<itk::Image<double, 2>, itk::Image<unsigned char, 2>>(30, -20.0, 275.0);
}

TEST(NonOscillatorySubdivisionPixels, FloatToShort)
{
  CompareWithReference<itk::Image<float, 2>, itk::Image<short, 2>>(30, -40000.0, 40000.0);
}
