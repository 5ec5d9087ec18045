// SPDX-License-Identifier: Apache-2.0
#include "SubdivisionKernelTiles.h"

#include "gtest/gtest.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

// The kernel without images: tiles of random values against the slow reference, and its promises.

namespace
{
using namespace SubdivisionKernelTiles;

template <typename T>
class SubdivisionKernel : public ::testing::Test
{};
using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SubdivisionKernel, Reals);

TYPED_TEST(SubdivisionKernel, IsTheReferenceAlongAnyAxes)
{
  for (const std::string & target : Target::GetNames())
  {
    for (int scheme = 0; scheme < NumberOfSchemes; ++scheme)
    {
      for (const Axes & axes : AllAxes)
      {
        ExpectReference<TypeParam>(target, scheme, 2, axes, { 11, 3, 4 });
        ExpectReference<TypeParam>(target, scheme, 3.5, axes, { 5, 2, 9 });
      }
    }
  }
}

TYPED_TEST(SubdivisionKernel, IsTheReferenceAtAnyWidth)
{
  std::vector<std::size_t> widths{ 255, 256, 257, 1023, 1024, 1025 };
  for (std::size_t width = 1; width <= 80; ++width)
  {
    widths.push_back(width);
  }
  for (const std::string & target : Target::GetNames())
  {
    for (int scheme = 0; scheme < NumberOfSchemes; ++scheme)
    {
      for (const std::size_t width : widths)
      {
        ExpectReference<TypeParam>(target, scheme, 2, { true, false, false }, { width, 1, 1 });
        ExpectReference<TypeParam>(target, scheme, 2, { false, false, true }, { width, 1, 2 });
      }
    }
  }
}

TYPED_TEST(SubdivisionKernel, KeepsConstantsUpToTheLargestValue)
{
  const double largest = static_cast<double>(std::numeric_limits<TypeParam>::max());
  const double powerOfTwo = std::ldexp(1.0, std::numeric_limits<TypeParam>::max_exponent - 1);
  for (const std::string & target : Target::GetNames())
  {
    for (int scheme = 0; scheme < NumberOfSchemes; ++scheme)
    {
      // Weights of 10 bits are exact with numbers of few digits; sums of others round, but for what is clamped.
      const bool isExact = Schemes[scheme].IsBounded;
      for (const Axes & axes : AllAxes)
      {
        for (const double value :
             { 42.0, 4095.0, 1.5 * powerOfTwo, -1.75 * powerOfTwo, 0.53 * largest, -0.77 * largest, largest })
        {
          TestTile<TypeParam> tile(Schemes[scheme], axes, { 9, 3, 2 });
          std::fill(tile.Values.values.begin(), tile.Values.values.end(), value);
          Kernel<TypeParam> kernel(Schemes[scheme], 2, axes, tile.Size, Target::Named(target));
          const bool        hasFewDigits = std::abs(value) <= 4095 || std::fmod(value, powerOfTwo / 4) == 0;
          const auto        expected = static_cast<TypeParam>(value);
          for (const TypeParam child : Compute(kernel, tile).Values)
          {
            if (isExact || hasFewDigits)
            {
              ASSERT_EQ(expected, child) << target << " " << Schemes[scheme].Name;
            }
            else
            {
              const double ulps = (child / expected - 1) / std::numeric_limits<TypeParam>::epsilon();
              ASSERT_LE(std::abs(ulps), 2) << target << " " << Schemes[scheme].Name << " " << value;
            }
          }
        }
      }
    }
  }
}

TYPED_TEST(SubdivisionKernel, IsFiniteForLargeVoxels)
{
  const double quarter = static_cast<double>(std::numeric_limits<TypeParam>::max()) / 4;
  std::mt19937 generator(3);
  for (const std::string & target : Target::GetNames())
  {
    for (int scheme = 0; scheme < NumberOfSchemes; ++scheme)
    {
      TestTile<TypeParam> tile(Schemes[scheme], { true, true, true }, { 19, 6, 7 });
      for (double & value : tile.Values.values)
      {
        value = generator() % 2 == 0 ? quarter : -quarter;
      }
      Kernel<TypeParam> kernel(Schemes[scheme], 2, { true, true, true }, tile.Size, Target::Named(target));
      for (const TypeParam child : Compute(kernel, tile).Values)
      {
        ASSERT_TRUE(std::isfinite(child)) << target << " " << Schemes[scheme].Name;
      }
    }
  }
}

TYPED_TEST(SubdivisionKernel, RefusesWhatItCannotDo)
{
  using Tested = Kernel<TypeParam>;
  const Axes     all{ true, true, true };
  const TileSize size{ 4, 4, 4 };
  EXPECT_THROW(Tested(Schemes[0], 1, all, size), std::invalid_argument);
  EXPECT_THROW(Tested(Schemes[4], -0.5, all, size), std::invalid_argument);
  EXPECT_THROW(Tested(Schemes[4], std::numeric_limits<double>::infinity(), all, size), std::invalid_argument);
  EXPECT_THROW(Tested(Schemes[0], 2, { false, false, false }, size), std::invalid_argument);
  EXPECT_THROW(Tested(Schemes[0], 2, all, { 4, 0, 4 }), std::invalid_argument);
  // Sizes in bytes that overflow would be little memory.
  constexpr std::size_t huge = std::numeric_limits<std::size_t>::max() / 4 + 1;
  EXPECT_THROW(Tested(Schemes[0], 2, all, { huge, 4, 4 }), std::invalid_argument);
  EXPECT_THROW(Tested(Schemes[0], 2, all, { 4, huge, 4 }), std::invalid_argument);
  EXPECT_NO_THROW(Tested(Schemes[4], 0, all, size));

  Tested kernel(Schemes[1], 2, all, size);
  for (const TileSize & large : { TileSize{ 5, 4, 4 }, TileSize{ 4, 5, 4 }, TileSize{ 4, 4, 5 } })
  {
    TestTile<TypeParam>     tile(Schemes[1], all, large);
    TestChildren<TypeParam> children(tile);
    tile.RowsUntilThrow = 1;
    EXPECT_THROW(kernel.Subdivide(tile.Size, tile, children), std::invalid_argument);
  }
}

TYPED_TEST(SubdivisionKernel, WorksAfterAnException)
{
  const Axes all{ true, true, true };
  for (int scheme = 0; scheme < NumberOfSchemes; ++scheme)
  {
    TestTile<TypeParam> tile(Schemes[scheme], all, { 13, 7, 11 });
    FillRandomly(tile, 5);
    Kernel<TypeParam>       kernel(Schemes[scheme], 2, all, tile.Size);
    const auto              expected = Compute(kernel, tile).Values;
    TestChildren<TypeParam> children(tile);
    tile.RowsUntilThrow = 60;
    EXPECT_THROW(kernel.Subdivide(tile.Size, tile, children), std::runtime_error);
    EXPECT_EQ(expected, Compute(kernel, tile).Values);
    children.RowsUntilThrow = 20;
    EXPECT_THROW(kernel.Subdivide(tile.Size, tile, children), std::runtime_error);
    EXPECT_EQ(expected, Compute(kernel, tile).Values);
  }
}

TYPED_TEST(SubdivisionKernel, HasTheTargetItWasMadeFor)
{
  const Axes                          all{ true, true, true };
  const std::vector<std::string>      names{ Target::GetNames().front(), "portable" };
  std::vector<std::vector<TypeParam>> alone(2);
  std::vector<std::vector<TypeParam>> together(2);
  const auto                          compute = [&](const std::size_t i) {
    TestTile<TypeParam> tile(Schemes[0], all, { 70, 9, 8 });
    FillRandomly(tile, 8);
    Kernel<TypeParam> kernel(Schemes[0], 2, all, tile.Size, Target::Named(names[i]));
    return Compute(kernel, tile).Values;
  };
  for (std::size_t i = 0; i < 2; ++i)
  {
    alone[i] = compute(i);
  }
  std::thread other([&] { together[0] = compute(0); });
  together[1] = compute(1);
  other.join();
  EXPECT_EQ(alone, together);
}

TYPED_TEST(SubdivisionKernel, IsUndisturbedByNonFiniteVoxelsOutsideTheStencil)
{
  const Axes all{ true, true, true };
  for (const double value : { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    for (int scheme = 0; scheme < NumberOfSchemes; ++scheme)
    {
      TestTile<TypeParam> tile(Schemes[scheme], all, { 21, 13, 12 });
      FillRandomly(tile, 9);
      Kernel<TypeParam>             kernel(Schemes[scheme], 2, all, tile.Size);
      const TestChildren<TypeParam> without = Compute(kernel, tile);
      const Index3                  place{ 10, 6, 6 };
      tile.Values(place) = value;
      const TestChildren<TypeParam> with = Compute(kernel, tile);
      const long                    radius = Schemes[scheme].Radius();
      bool                          isNoticed = false;
      Reference::ForEachIndex<3>({ 0, 0, 0 }, with.Size, [&](const Index3 & child) {
        bool isWithin = true;
        for (int w = 0; w < 3; ++w)
        {
          const long parent = child[w] / 2;
          const bool isUpper = child[w] % 2 != 0;
          isWithin = isWithin && place[w] >= parent - radius + isUpper && place[w] <= parent + radius - !isUpper;
        }
        isNoticed = isNoticed || !std::isfinite(with.At(child));
        if (!isWithin)
        {
          ASSERT_EQ(without.At(child), with.At(child)) << Schemes[scheme].Name;
        }
      });
      EXPECT_TRUE(isNoticed);
    }
  }
}

template <typename TElement, typename T>
void
ExpectRounding(const Target & target, const bool isInterleaved)
{
  using Limits = std::numeric_limits<TElement>;
  const double   lowest = static_cast<double>(Limits::lowest());
  std::vector<T> values{ T(0.5),
                         T(1.5),
                         T(2.5),
                         T(2.51),
                         T(-0.5),
                         T(-1.5),
                         T(-2.5),
                         T(3.49),
                         T(1e30),
                         T(-1e30),
                         std::numeric_limits<T>::quiet_NaN(),
                         std::numeric_limits<T>::infinity(),
                         -std::numeric_limits<T>::infinity(),
                         T(100),
                         T(-100),
                         T(77.4) };
  const TElement minus2 = static_cast<TElement>(std::max(-2.0, lowest));
  const TElement minus100 = static_cast<TElement>(std::max(-100.0, lowest));
  const TElement expected[] = {
    0,   2,        2, 3, 0, minus2, minus2, 3, Limits::max(), Limits::lowest(), 0, Limits::max(), Limits::lowest(),
    100, minus100, 77
  };
  for (std::size_t size = 0; size <= values.size(); size += isInterleaved ? 2 : 1)
  {
    std::vector<TElement> elements(size + 1, TElement(55));
    const ChildRow<T>     row(values.data(), size, isInterleaved, target);
    row.CopyTo(ElementTypeOf<TElement>(), elements.data());
    for (std::size_t i = 0; i < size; ++i)
    {
      ASSERT_EQ(expected[i], elements[i]) << target.GetName() << " element " << i << " of " << size;
    }
    ASSERT_EQ(TElement(55), elements[size]);
  }
}

TYPED_TEST(SubdivisionKernel, RoundsChildren)
{
  for (const std::string & name : Target::GetNames())
  {
    const Target & target = Target::Named(name);
    ExpectRounding<std::uint8_t, TypeParam>(target, false);
    ExpectRounding<std::int8_t, TypeParam>(target, false);
    ExpectRounding<std::uint16_t, TypeParam>(target, false);
    ExpectRounding<std::int16_t, TypeParam>(target, false);
    ExpectRounding<std::uint32_t, TypeParam>(target, false);
    ExpectRounding<std::int32_t, TypeParam>(target, false);
    ExpectRounding<std::uint64_t, TypeParam>(target, false);
    ExpectRounding<std::int64_t, TypeParam>(target, false);
  }
  ExpectRounding<std::uint8_t, TypeParam>(Target::Named("portable"), true);
  ExpectRounding<std::int64_t, TypeParam>(Target::Named("portable"), true);
}

TYPED_TEST(SubdivisionKernel, WidensElements)
{
  for (const std::string & name : Target::GetNames())
  {
    for (int type = 0; type < 10; ++type)
    {
      WithElementType(static_cast<ElementType>(type), [&](const auto tag) {
        using Element = typename decltype(tag)::Type;
        for (std::size_t size = 0; size < 70; ++size)
        {
          std::vector<Element>   elements;
          std::vector<TypeParam> values(size + 1, TypeParam(-3));
          for (std::size_t i = 0; i < size; ++i)
          {
            elements.push_back(static_cast<Element>(static_cast<long>(i * 37) - 1000));
          }
          Target::Named(name).Widen(static_cast<ElementType>(type), elements.data(), size, values.data());
          for (std::size_t i = 0; i < size; ++i)
          {
            ASSERT_EQ(static_cast<TypeParam>(elements[i]), values[i]) << name << " type " << type;
          }
          ASSERT_EQ(TypeParam(-3), values[size]);
        }
      });
    }
  }
}

} // namespace
