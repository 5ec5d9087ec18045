// SPDX-License-Identifier: Apache-2.0
#include "SubdivisionKernelTiles.h"

// What the kernel promises of numbers: exact children, tensions, ranges near the largest values, values near denormals.

namespace
{
using namespace SubdivisionKernelTiles;

template <typename T>
class SubdivisionKernelPromises : public ::testing::Test
{};
using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SubdivisionKernelPromises, Reals);

/** Children along x of a row, beyond whose ends its last values go on. */
std::vector<double>
SubdivideRow(const std::vector<double> & row, const Scheme & scheme, const std::string & target)
{
  const Axes       axes{ true, false, false };
  TestTile<double> tile(scheme, axes, { row.size(), 1, 1 });
  const long       last = static_cast<long>(row.size()) - 1;
  Reference::ForEachIndex<3>(tile.Values.lower, tile.Values.size, [&](const Index3 & i) {
    tile.Values(i) = row[static_cast<std::size_t>(std::min(std::max(i[0], 0L), last))];
  });
  Kernel<double> kernel(scheme, 2, axes, tile.Size, Target::Named(target));
  return Compute(kernel, tile).Values;
}

struct Fraction
{
  double Numerator;
  double Denominator;
};

/** docs/scheme.md, section 5; the last row has quotients that no binary number equals. */
TEST(SubdivisionKernelFractions, RestoredChildrenAreTheFractions)
{
  const std::vector<std::pair<std::vector<double>, std::vector<Fraction>>> cases{
    { { 0, 0, 0, 0, 0, 1, 1, 1, 1, 1 },
      { { 0, 1 }, { 0, 1 }, { 0, 1 },        { 0, 1 },         { 0, 1 }, { 0, 1 }, { 0, 1 },
        { 0, 1 }, { 0, 1 }, { 9679, 32768 }, { 23089, 32768 }, { 1, 1 }, { 1, 1 }, { 1, 1 },
        { 1, 1 }, { 1, 1 }, { 1, 1 },        { 1, 1 },         { 1, 1 }, { 1, 1 } } },
    { { 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0 },
      { { 0, 1 }, { 0, 1 },         { 0, 1 },         { 0, 1 },         { 0, 1 },         { 0, 1 },
        { 0, 1 }, { 0, 1 },         { 55, 8192 },     { 12023, 32768 }, { 27357, 32768 }, { 1, 1 },
        { 1, 1 }, { 27357, 32768 }, { 12023, 32768 }, { 55, 8192 },     { 0, 1 },         { 0, 1 },
        { 0, 1 }, { 0, 1 },         { 0, 1 },         { 0, 1 },         { 0, 1 },         { 0, 1 } } },
    { { 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0 },
      { { 0, 1 },         { 0, 1 },      { 0, 1 },      { 0, 1 },         { 0, 1 },         { 0, 1 },
        { 0, 1 },         { 0, 1 },      { 891, 8192 }, { 14499, 32768 }, { 23793, 32768 }, { 23793, 32768 },
        { 14499, 32768 }, { 891, 8192 }, { 0, 1 },      { 0, 1 },         { 0, 1 },         { 0, 1 },
        { 0, 1 },         { 0, 1 },      { 0, 1 },      { 0, 1 } } },
    { { 0, 0, 1, 3, 2, 5, 4, 4, 0, 7, 7, 6 },
      { { 0, 1 },
        { 0, 1 },
        { 0, 1 },
        { 3191, 65536 },
        { 46453, 65536 },
        { 25441, 16384 },
        { 1433, 512 },
        { 717, 256 },
        { 507, 256 },
        { 163, 64 },
        { 141, 32 },
        { 2609, 512 },
        { 2227, 512 },
        { 1067, 256 },
        { 2856695, 720896 },
        { 1785647, 720896 },
        { 205133, 720896 },
        { 938833, 720896 },
        { 3744219, 720896 },
        { 5408343, 720896 },
        { 7, 1 },
        { 7, 1 },
        { 221639, 32768 },
        { 101087, 16384 } } }
  };
  for (const std::string & target : Target::GetNames())
  {
    for (const auto & [row, fractions] : cases)
    {
      const std::vector<double> children = SubdivideRow(row, FindScheme("restored"), target);
      ASSERT_EQ(fractions.size(), children.size());
      for (std::size_t m = 0; m < children.size(); ++m)
      {
        const double expected = fractions[m].Numerator / fractions[m].Denominator;
        const double digits = fractions[m].Denominator == 720896 ? 4 * std::numeric_limits<double>::epsilon() : 0;
        EXPECT_NEAR(expected, children[m], digits * expected) << target << " child " << m;
      }
    }
  }
}

TYPED_TEST(SubdivisionKernelPromises, RestoredTensionIsTheReferences)
{
  for (const std::string & target : Target::GetNames())
  {
    for (const double tension : { 0.0, 0.5, 2.0, 8.0 })
    {
      for (const Axes & axes : AllAxes)
      {
        ExpectReference<TypeParam>(target, 4, tension, axes, { 21, 3, 4 });
      }
    }
  }
}

/** The range of the voxels from \c first to \c last of each axis, counted from the parent of a child. */
template <typename T>
std::pair<double, double>
RangeAround(const TestTile<T> & tile, const Index3 & child, const long first, const long last)
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  Reference::ForEachIndex<3>(
    { first, first, first }, { last - first + 1, last - first + 1, last - first + 1 }, [&](const Index3 & offset) {
      Index3 voxel;
      for (int w = 0; w < 3; ++w)
      {
        // The range is the upper child's; that of the lower one is its mirror image.
        const long side = child[w] % 2 != 0 ? 0 : -(first + last);
        voxel[w] = child[w] / 2 + offset[w] + side;
      }
      low = std::min(low, tile.Values(voxel));
      high = std::max(high, tile.Values(voxel));
    });
  return { low, high };
}

/** Bounded linear, and restored without tension: the 27 voxels around the parent, exactly. B-spline: its stencil of six
 * along each axis, but for two units in the last place. */
TYPED_TEST(SubdivisionKernelPromises, RangeIsKeptUpToTheLargestValues)
{
  const Axes   all{ true, true, true };
  const double largest = static_cast<double>(std::numeric_limits<TypeParam>::max());
  const double unit = static_cast<double>(std::numeric_limits<TypeParam>::epsilon());
  for (const std::string & target : Target::GetNames())
  {
    for (const int scheme : { 2, 3, 4 })
    {
      for (const double lowest : { -1.0, 0.0, 0.5, 0.999, 1 - 4 * unit })
      {
        std::mt19937                           generator(23);
        std::uniform_real_distribution<double> share(lowest, 1.0);
        TestTile<TypeParam>                    tile(Schemes[scheme], all, { 19, 3, 4 });
        for (double & value : tile.Values.values)
        {
          value =
            generator() % 4 == 0 ? largest : static_cast<double>(static_cast<TypeParam>(share(generator) * largest));
        }
        Kernel<TypeParam> kernel(Schemes[scheme], scheme == 4 ? 0 : 2, all, tile.Size, Target::Named(target));
        const TestChildren<TypeParam> children = Compute(kernel, tile);
        const bool                    isSpline = scheme == 3;
        Reference::ForEachIndex<3>({ 0, 0, 0 }, children.Size, [&](const Index3 & child) {
          const auto [low, high] = isSpline ? RangeAround(tile, child, -2, 3) : RangeAround(tile, child, -1, 1);
          const double value = static_cast<double>(children.At(child));
          const double slack = isSpline ? 2 * unit : 0.0;
          ASSERT_TRUE(std::isfinite(value)) << target << " " << Schemes[scheme].Name << " " << lowest;
          ASSERT_GE(value, low - slack * std::abs(low)) << target << " " << Schemes[scheme].Name << " " << lowest;
          ASSERT_LE(value / 2, high / 2 + slack * std::abs(high) / 2)
            << target << " " << Schemes[scheme].Name << " " << lowest;
        });
      }
    }
  }
}

/** Voxels are scaled by 2^-8, so the smallest step that is left of them is 2^8 times the smallest number. */
TYPED_TEST(SubdivisionKernelPromises, SmallestValuesLoseDigitsOnly)
{
  using Limits = std::numeric_limits<TypeParam>;
  const Axes   all{ true, true, true };
  const double step = 256 * static_cast<double>(Limits::denorm_min());
  const double scale = static_cast<double>(Limits::min()) / 4;
  for (const std::string & target : Target::GetNames())
  {
    for (int scheme = 0; scheme < NumberOfSchemes; ++scheme)
    {
      SCOPED_TRACE(target + " " + Schemes[scheme].Name);
      TestTile<TypeParam> tile(Schemes[scheme], all, { 19, 3, 4 });
      FillRandomly(tile, 29);
      for (double & value : tile.Values.values)
      {
        value = static_cast<TypeParam>(value * scale);
      }
      Kernel<TypeParam>             kernel(Schemes[scheme], 2, all, tile.Size, Target::Named(target));
      const TestChildren<TypeParam> children = Compute(kernel, tile);

      // The reference is given what the kernel read, but of usual size, where its own products keep their digits.
      TestTile<TypeParam> scaled = tile;
      for (double & value : scaled.Values.values)
      {
        value /= scale;
      }
      const Grid3 expected = ComputeReference(scaled, scheme, 2, all);
      Reference::ForEachIndex<3>(expected.lower, expected.size, [&](const Index3 & i) {
        const double child = static_cast<double>(children.At(i)) / scale;
        ASSERT_NEAR(expected(i), child, 64 * step / scale) << i[0] << " " << i[1] << " " << i[2];
        if (scheme == 2 || scheme == 3)
        {
          const auto [low, high] = scheme == 3 ? RangeAround(scaled, i, -2, 3) : RangeAround(scaled, i, -1, 1);
          ASSERT_GE(child, low - 2 * step / scale);
          ASSERT_LE(child, high + 2 * step / scale);
        }
      });

      // The smallest constant that keeps all its digits, and the largest one of which none is left.
      for (const auto & [constant, kept] : { std::pair<double, double>(256 * static_cast<double>(Limits::min()), 1),
                                             std::pair<double, double>(step / 2, 0) })
      {
        std::fill(tile.Values.values.begin(), tile.Values.values.end(), constant);
        for (const TypeParam child : Compute(kernel, tile).Values)
        {
          ASSERT_EQ(constant * kept, static_cast<double>(child));
        }
      }
    }
  }
}

} // namespace
