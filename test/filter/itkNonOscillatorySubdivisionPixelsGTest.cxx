// SPDX-License-Identifier: Apache-2.0
// Other pixel types against the slow reference: further integers, several components, and an output type that differs
// from the input's.

#include "SubdivisionRandomCases.h"

#include "itkRGBPixel.h"
#include "itkVector.h"

#include <complex>

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

/** The real and the imaginary part each on its own. */
TEST(NonOscillatorySubdivisionPixels, Complex)
{
  CompareWithReference<itk::Image<std::complex<float>, 2>>(30, -1.0, 1.0, 2);
  CompareWithReference<itk::Image<std::complex<double>, 3>>(10, -1.0, 1.0, 2);
}

/** The boundary conditions that are asked, too, supply both parts. */
TEST(NonOscillatorySubdivisionPixels, ComplexOutside)
{
  using Complexes = itk::Image<std::complex<double>, 1>;
  class Ones : public itk::ConstantBoundaryCondition<Complexes>
  {
  public:
    std::complex<double>
    GetPixel(const IndexType &, const Complexes *) const override
    {
      return { 1.0, -2.0 };
    }
  };
  const auto input = MakeImage<Complexes>(MakeRegion<Complexes>({ 0 }, { 6 }));
  input->FillBuffer({ 1.0, -2.0 });
  Ones ones;
  auto filter = itk::NonOscillatorySubdivisionImageFilter<Complexes>::New();
  filter->SetBoundaryCondition(&ones);
  const auto output = RunFilter(filter.GetPointer(), input.GetPointer());
  for (long m = 0; m < 12; ++m)
  {
    EXPECT_EQ(output->GetPixel({ { m } }), std::complex<double>(1.0, -2.0)) << m;
  }
}

/** A linear scheme overshoots a step of bits; what is stored are bits. */
TEST(NonOscillatorySubdivisionPixels, Bool)
{
  using Bits = itk::Image<bool, 1>;
  auto filter = itk::NonOscillatorySubdivisionImageFilter<Bits>::New();
  filter->SetScheme(SchemeEnum::Linear);
  const auto input = LineOf<Bits>({ 0, 0, 0, 0, 0, 1, 1, 1, 1, 1 });
  const auto output = RunFilter(filter.GetPointer(), input.GetPointer());
  for (long m = 0; m < 20; ++m)
  {
    EXPECT_EQ(output->GetPixel({ { m } }), m >= 10) << m;
  }
}
