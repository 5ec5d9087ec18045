// SPDX-License-Identifier: Apache-2.0
// From real values to integer pixels: rounding to nearest, saturation, and 0 for NaN.

#include "SubdivisionTestHelpers.h"

#include "NonOscillatorySubdivision/Kernel.h"
#include "memory/NonTemporalWriter.h"

#include <algorithm>
#include <numeric>

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
    RunFilter(filter.GetPointer(), LineOf<itk::Image<TReal, 1>>(std::vector<double>(71, value)).GetPointer());
  const TInteger * first = ScalarsOf(output.GetPointer());
  for (std::size_t i = 1; i < 142; ++i)
  {
    EXPECT_EQ(+first[i], +first[0]) << "child " << i << " of " << value;
  }
  return first[0];
}

std::vector<unsigned char>
CountedBytes(const std::size_t count)
{
  std::vector<unsigned char> bytes(count);
  std::iota(bytes.begin(), bytes.end(), static_cast<unsigned char>(1));
  return bytes;
}

template <typename TReal, typename TInteger>
void
ExpectConversions()
{
  using Limits = std::numeric_limits<TInteger>;
  const bool isSigned = Limits::is_signed;
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
  }
}

/** Values whose conversion is at issue: infinities, NaN, the ends of the range and beyond, and ties, which go to the
 * even integer. */
template <typename TInteger>
std::vector<std::pair<double, TInteger>>
DelicateConversions()
{
  using Limits = std::numeric_limits<TInteger>;
  const double infinity = std::numeric_limits<double>::infinity();
  const double highest = static_cast<double>(Limits::max());
  const double lowest = static_cast<double>(Limits::lowest());
  const auto   orZero = [](int value) { return static_cast<TInteger>(Limits::is_signed ? value : 0); };
  return { { infinity, Limits::max() },
           { -infinity, Limits::lowest() },
           { std::nan(""), TInteger{ 0 } },
           { highest * 1.5, Limits::max() },
           { lowest * 1.5 - 100.0, Limits::lowest() },
           { 0.5, TInteger{ 0 } },
           { 1.5, TInteger{ 2 } },
           { 2.5, TInteger{ 2 } },
           { -0.5, TInteger{ 0 } },
           { -1.5, orZero(-2) },
           { -2.5, orZero(-2) },
           { 0.49999997, TInteger{ 0 } },
           { -0.0, TInteger{ 0 } } };
}

/** Room for rows of children of up to 70 voxels, in whole vectors. */
constexpr std::size_t RowLength = 2 * (70 + 16);

/** Where in a row of the kernel's children each child stands, lower, upper, lower, ... */
std::vector<std::size_t>
FindChildren(std::size_t count, const itk::Subdivision::Target & target)
{
  std::vector<float> row(RowLength);
  std::iota(row.begin(), row.end(), 0.0f);
  std::vector<float> children(2 * count);
  itk::Subdivision::ChildRow<float>(row.data(), 2 * count, true, target)
    .CopyTo(itk::Subdivision::ElementType::Float, children.data());
  return { children.begin(), children.end() };
}

/** The conversion of rows in vector code, at every position of rows of every length up to 70. */
template <typename TInteger>
void
ExpectRowsConverted(const itk::Subdivision::Target & target)
{
  const auto values = DelicateConversions<TInteger>();
  for (std::size_t count = 1; count <= 70; ++count)
  {
    const auto            places = FindChildren(count, target);
    std::vector<float>    row(RowLength);
    std::vector<TInteger> out(2 * count + 1, TInteger{ 77 });
    for (std::size_t i = 0; i < 2 * count; ++i)
    {
      row[places[i]] = static_cast<float>(values[(i + count) % values.size()].first);
    }
    itk::Subdivision::ChildRow<float>(row.data(), 2 * count, true, target)
      .CopyTo(itk::Subdivision::ElementTypeOf<TInteger>(), out.data());
    for (std::size_t i = 0; i < 2 * count; ++i)
    {
      EXPECT_EQ(+out[i], +values[(i + count) % values.size()].second) << row[places[i]] << ", row of " << count;
    }
    EXPECT_EQ(+out[2 * count], 77) << "written past a row of " << count;
  }
}

/** Every child of a row is there once. */
void
ExpectChildrenOnce(const itk::Subdivision::Target & target)
{
  for (std::size_t count = 1; count <= 70; ++count)
  {
    auto places = FindChildren(count, target);
    std::sort(places.begin(), places.end());
    EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end()) << count;
    EXPECT_LT(places.back(), RowLength);
  }
}

template <typename TInteger>
void
ExpectValuesRounded()
{
  for (const auto & [value, expected] : DelicateConversions<TInteger>())
  {
    TInteger rounded{};
    itk::Subdivision::ChildRow<double>(&value, 1, false, itk::Subdivision::Target::Fastest())
      .CopyTo(itk::Subdivision::ElementTypeOf<TInteger>(), &rounded);
    EXPECT_EQ(rounded, expected) << value;
  }
}

} // namespace

TEST(NonOscillatorySubdivisionConversion, RowsInVectorCode)
{
  for (const std::string & name : itk::Subdivision::Target::GetNames())
  {
    SCOPED_TRACE(name);
    const itk::Subdivision::Target & target = itk::Subdivision::Target::Named(name);
    ExpectRowsConverted<std::int8_t>(target);
    ExpectRowsConverted<std::uint8_t>(target);
    ExpectRowsConverted<std::int16_t>(target);
    ExpectRowsConverted<std::uint16_t>(target);
    ExpectChildrenOnce(target);
  }
}

/** Copies of every length to every place within a cache line, with nothing written around them. */
TEST(NonOscillatorySubdivisionConversion, CopiesPastTheCache)
{
  const std::vector<unsigned char> from = CountedBytes(300);
  for (std::size_t begin = 0; begin <= 64; ++begin)
  {
    for (std::size_t bytes = 0; bytes <= 200; bytes += 1 + bytes / 8)
    {
      std::vector<unsigned char> to(400, 0);
      std::vector<unsigned char> expected(400, 0);
      std::copy_n(from.data() + 3, bytes, expected.data() + begin);
      {
        itk::Subdivision::NonTemporalWriter stream;
        stream.Copy(from.data() + 3, bytes, to.data() + begin);
      }
      ASSERT_EQ(to, expected) << bytes << " bytes at " << begin;
    }
  }
}

/** Copies that continue one another, of every length, and then one elsewhere. */
TEST(NonOscillatorySubdivisionConversion, ContinuesCopiesPastTheCache)
{
  const std::vector<unsigned char> from = CountedBytes(2000);
  for (std::size_t begin = 0; begin < 64; begin += 7)
  {
    for (std::size_t bytes = 1; bytes <= 140; ++bytes)
    {
      std::vector<unsigned char> to(2000, 0);
      std::vector<unsigned char> expected(2000, 0);
      const std::size_t          copies = 1000 / bytes;
      std::copy_n(from.data(), copies * bytes, expected.data() + begin);
      std::copy_n(from.data() + 11, bytes, expected.data() + 1500);
      {
        itk::Subdivision::NonTemporalWriter stream;
        for (std::size_t copy = 0; copy < copies; ++copy)
        {
          stream.Copy(from.data() + copy * bytes, bytes, to.data() + begin + copy * bytes);
        }
        stream.Copy(from.data() + 11, bytes, to.data() + 1500);
      }
      ASSERT_EQ(to, expected) << copies << " copies of " << bytes << " bytes at " << begin;
    }
  }
}

TEST(NonOscillatorySubdivisionConversion, ValuesOneByOne)
{
  ExpectValuesRounded<signed char>();
  ExpectValuesRounded<unsigned char>();
  ExpectValuesRounded<short>();
  ExpectValuesRounded<unsigned short>();
  ExpectValuesRounded<int>();
  ExpectValuesRounded<unsigned int>();
  ExpectValuesRounded<long long>();
  ExpectValuesRounded<unsigned long long>();
}

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
    RunFilter(filter.GetPointer(), LineOf<Bytes>({ 0, 0, 0, 0, 0, 255, 255, 255, 255, 255 }).GetPointer());
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
  const auto output =
    RunFilter(filter.GetPointer(), LineOf<Bytes>({ 0, 0, 0, 0, 0, 128, 128, 128, 128, 128 }).GetPointer());
  EXPECT_EQ(ScalarsOf(output.GetPointer())[8], -14.0f);
  EXPECT_EQ(ScalarsOf(output.GetPointer())[11], 142.0f);
  EXPECT_EQ(ScalarsOf(output.GetPointer())[5], 1.25f);
}
