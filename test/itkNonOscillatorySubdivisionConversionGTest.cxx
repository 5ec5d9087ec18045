// SPDX-License-Identifier: Apache-2.0
// From real values to integer pixels: rounding to nearest, saturation, and 0 for NaN.

#include "SubdivisionTestHelpers.h"

using namespace SubdivisionTest;

namespace
{

template <typename TReal, typename TInteger>
using Converter = itk::NonOscillatorySubdivisionImageFilter<itk::Image<TReal, 1>, itk::Image<TInteger, 1>>;

/** What every child of a line of equal values becomes; the line is long enough for a full vector and a rest. */
template <typename TReal, typename TInteger>
TInteger
ConvertedFrom(double value, SchemeEnum scheme)
{
  auto filter = Converter<TReal, TInteger>::New();
  filter->SetScheme(scheme);
  const auto output =
    Run(filter.GetPointer(), LineOf<itk::Image<TReal, 1>>(std::vector<double>(71, value)).GetPointer());
  const TInteger * first = ScalarsOf(output.GetPointer());
  for (std::size_t i = 1; i < 142; ++i)
  {
    EXPECT_EQ(+first[i], +first[0]) << "child " << i << " of " << value;
  }
  return first[0];
}

template <typename TReal, typename TInteger>
void
ExpectConversions()
{
  using Limits = std::numeric_limits<TInteger>;
  const double infinity = std::numeric_limits<double>::infinity();
  const bool   isSigned = Limits::is_signed;
  for (const SchemeEnum scheme : AllSchemes())
  {
    SCOPED_TRACE(testing::Message() << scheme << ", " << sizeof(TInteger) << " bytes, signed " << isSigned);
    const auto converted = [&](double value) { return ConvertedFrom<TReal, TInteger>(value, scheme); };
    EXPECT_EQ(converted(7.0), TInteger{ 7 });
    EXPECT_EQ(converted(2.4), TInteger{ 2 });
    EXPECT_EQ(converted(2.6), TInteger{ 3 });
    EXPECT_EQ(converted(-2.4), isSigned ? static_cast<TInteger>(-2) : TInteger{ 0 });
    EXPECT_EQ(converted(-2.6), isSigned ? static_cast<TInteger>(-3) : TInteger{ 0 });
    EXPECT_EQ(converted(1e30), Limits::max());
    EXPECT_EQ(converted(-1e30), Limits::lowest());
    EXPECT_EQ(converted(std::nan("")), TInteger{ 0 });
    // Infinities that meet in a sum of both signs are NaN; the B-spline's masks are positive.
    if (scheme == SchemeEnum::BSpline)
    {
      EXPECT_EQ(converted(infinity), Limits::max());
      EXPECT_EQ(converted(-infinity), Limits::lowest());
    }
  }
}

} // namespace

TEST(NonOscillatorySubdivisionConversion, FloatToEightBits)
{
  ExpectConversions<float, signed char>();
  ExpectConversions<float, unsigned char>();
}

TEST(NonOscillatorySubdivisionConversion, FloatToSixteenBits)
{
  ExpectConversions<float, short>();
  ExpectConversions<float, unsigned short>();
}

TEST(NonOscillatorySubdivisionConversion, DoubleToThirtyTwoBits)
{
  ExpectConversions<double, int>();
  ExpectConversions<double, unsigned int>();
}

TEST(NonOscillatorySubdivisionConversion, DoubleToSixtyFourBits)
{
  ExpectConversions<double, long long>();
  ExpectConversions<double, unsigned long long>();
}

/** At the ends of the range, where casting back and forth may overflow. */
TEST(NonOscillatorySubdivisionConversion, EndsOfTheRange)
{
  const SchemeEnum scheme = SchemeEnum::NonOscillatory;
  EXPECT_EQ((ConvertedFrom<float, unsigned char>(255.4, scheme)), 255);
  EXPECT_EQ((ConvertedFrom<float, unsigned char>(255.6, scheme)), 255);
  EXPECT_EQ((ConvertedFrom<float, signed char>(-128.6, scheme)), -128);
  EXPECT_EQ((ConvertedFrom<float, unsigned short>(65535.3, scheme)), 65535);
  EXPECT_EQ((ConvertedFrom<float, unsigned short>(65537.0, scheme)), 65535);
  EXPECT_EQ((ConvertedFrom<double, int>(2147483647.4, scheme)), 2147483647);
  EXPECT_EQ((ConvertedFrom<double, int>(2147483648.0, scheme)), 2147483647);
  EXPECT_EQ((ConvertedFrom<double, unsigned int>(4294967294.0, scheme)), 4294967294u);
  EXPECT_EQ((ConvertedFrom<double, long long>(9223372036854775808.0, scheme)), std::numeric_limits<long long>::max());
  EXPECT_EQ((ConvertedFrom<double, unsigned long long>(18446744073709551616.0, scheme)),
            std::numeric_limits<unsigned long long>::max());
}

/** A step that the linear scheme overshoots at both ends of the range. */
TEST(NonOscillatorySubdivisionConversion, OvershootsSaturate)
{
  using Bytes = itk::Image<unsigned char, 1>;
  auto filter = itk::NonOscillatorySubdivisionImageFilter<Bytes>::New();
  filter->SetScheme(SchemeEnum::Linear);
  const auto output =
    Run(filter.GetPointer(), LineOf<Bytes>({ 0, 0, 0, 0, 0, 255, 255, 255, 255, 255 }).GetPointer());
  const std::vector<int> expected{ 0, 0, 0, 0, 0, 2, 3, 0, 0, 53, 202, 255, 255, 252, 253, 255, 255, 255, 255, 255 };
  for (std::size_t m = 0; m < expected.size(); ++m)
  {
    EXPECT_EQ(+ScalarsOf(output.GetPointer())[m], expected[m]) << "child " << m;
  }
}

/** Real output is neither rounded nor clamped, whatever the integers it comes from. */
TEST(NonOscillatorySubdivisionConversion, RealOutputKeepsOvershoots)
{
  using Bytes = itk::Image<unsigned char, 1>;
  using Reals = itk::Image<float, 1>;
  auto filter = itk::NonOscillatorySubdivisionImageFilter<Bytes, Reals>::New();
  filter->SetScheme(SchemeEnum::Linear);
  const auto output = Run(filter.GetPointer(), LineOf<Bytes>({ 0, 0, 0, 0, 0, 128, 128, 128, 128, 128 }).GetPointer());
  EXPECT_EQ(ScalarsOf(output.GetPointer())[8], -14.0f);
  EXPECT_EQ(ScalarsOf(output.GetPointer())[11], 142.0f);
  EXPECT_EQ(ScalarsOf(output.GetPointer())[5], 1.25f);
}
