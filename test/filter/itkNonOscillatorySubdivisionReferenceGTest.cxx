// SPDX-License-Identifier: Apache-2.0
// The slow reference itself is held to the numbers of docs/scheme.md, so that it can be trusted as an oracle.

#include "common/SubdivisionReference.h"
#include "SubdivisionNumbers.h"

#include "itkGTest.h"

#include <random>

namespace ref = SubdivisionReference;

namespace
{

using Line = ref::Grid<1>;

Line
MakeLine(const std::vector<double> & values)
{
  Line line({ 0 }, { static_cast<long>(values.size()) });
  line.values = values;
  return line;
}

ref::Settings<1>
LineSettings(ref::Scheme scheme, double tension = 2.0)
{
  ref::Settings<1> settings;
  settings.scheme = scheme;
  settings.tension = tension;
  return settings;
}

void
ExpectLine(const std::vector<double> & input, ref::Scheme scheme, const std::vector<double> & expectedTimes1024)
{
  const Line output = ref::Subdivide<1>(MakeLine(input), LineSettings(scheme));
  ASSERT_EQ(output.values.size(), expectedTimes1024.size());
  for (std::size_t m = 0; m < expectedTimes1024.size(); ++m)
  {
    EXPECT_EQ(output.values[m] * 1024.0, expectedTimes1024[m]) << "child " << m;
  }
}

template <unsigned int D>
ref::Grid<D>
RandomGrid(const ref::Index<D> & size, unsigned int seed)
{
  std::mt19937                           engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return ref::MakeGrid<D>({}, size, [&](const ref::Index<D> &) { return uniform(engine); });
}

template <unsigned int D>
double
LargestDifference(const ref::Grid<D> & a, const ref::Grid<D> & b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
  {
    largest = std::max(largest, std::abs(a.values[i] - b.values.at(i)));
  }
  return largest;
}

} // namespace

TEST(SubdivisionReference, StepAndBar)
{
  using namespace SubdivisionNumbers;
  ExpectLine(Step(), ref::Scheme::Linear, StepLinear());
  ExpectLine(Step(), ref::Scheme::NonOscillatory, StepNonOscillatory());
  ExpectLine(Bar(), ref::Scheme::Linear, BarLinear());
  ExpectLine(Bar(), ref::Scheme::NonOscillatory, BarNonOscillatory());
}

TEST(SubdivisionReference, SixthOrderOnSine)
{
  for (const auto & [cells, expected] : SubdivisionNumbers::SineErrors())
  {
    for (const ref::Scheme scheme : { ref::Scheme::Linear, ref::Scheme::NonOscillatory })
    {
      auto settings = LineSettings(scheme, 1.01);
      settings.boundary = ref::Periodic<1>();
      const Line   output = ref::Subdivide<1>(MakeLine(SubdivisionNumbers::SineAverages(cells)), settings);
      const double error =
        SubdivisionNumbers::LargestDifference(output.values, SubdivisionNumbers::SineAverages(2 * cells));
      EXPECT_NEAR(error, expected, 0.0006 * expected) << cells << " cells";
    }
  }
}

TEST(SubdivisionReference, LinearMovesAveragesByTheSixthDifference)
{
  const Line input = RandomGrid<1>({ 20 }, 1);
  auto       settings = LineSettings(ref::Scheme::Linear);
  settings.boundary = ref::Periodic<1>();
  const Line output = ref::Subdivide<1>(input, settings);
  for (long j = 0; j < 20; ++j)
  {
    const double mean = (output({ 2 * j }) + output({ 2 * j + 1 })) / 2.0;
    EXPECT_NEAR(mean, SubdivisionNumbers::MeanOfChildren(input.values, j), 1e-14);
  }
}

/** The tensor product of a, and the sum over all subsets of axes without any clamp, are the same scheme. (Periodic,
 * because a zero flux boundary is flat outside the image, where every threshold vanishes whatever the tension.) */
TEST(SubdivisionReference, UnclampedSumIsTheLinearScheme)
{
  const auto       input = RandomGrid<3>({ 4, 5, 3 }, 2);
  ref::Settings<3> settings;
  settings.boundary = ref::Periodic<3>();
  settings.scheme = ref::Scheme::Linear;
  const auto linear = ref::Subdivide<3>(input, settings);
  settings.scheme = ref::Scheme::NonOscillatory;
  settings.tension = std::numeric_limits<double>::max();
  EXPECT_LT(LargestDifference(ref::Subdivide<3>(input, settings), linear), 1e-14);
}

/** The limit of a vanishing tension is the B-spline scheme, a convex combination that keeps constants. */
TEST(SubdivisionReference, NoTensionIsTheBSpline)
{
  const auto       input = RandomGrid<2>({ 6, 5 }, 3);
  ref::Settings<2> settings;
  settings.scheme = ref::Scheme::BSpline;
  const auto spline = ref::Subdivide<2>(input, settings);
  settings.scheme = ref::Scheme::NonOscillatory;
  settings.tension = 0.0;
  EXPECT_LT(LargestDifference(ref::Subdivide<2>(input, settings), spline), 1e-14);
}

TEST(SubdivisionReference, ConstantsAreKeptByEveryScheme)
{
  const auto input = ref::MakeGrid<4>({}, { 2, 1, 3, 2 }, [](const ref::Index<4> &) { return 0.75; });
  for (const auto scheme :
       { ref::Scheme::NonOscillatory, ref::Scheme::Linear, ref::Scheme::BoundedLinear, ref::Scheme::BSpline })
  {
    ref::Settings<4> settings;
    settings.scheme = scheme;
    settings.axes = { true, false, true, true };
    const auto output = ref::Subdivide<4>(input, settings);
    EXPECT_EQ(output.size, (ref::Index<4>{ 4, 1, 6, 4 }));
    for (const double value : output.values)
    {
      EXPECT_NEAR(value, 0.75, 1e-15);
    }
  }
}

/** An axis that is not subdivided takes no part: its samples are images of their own. */
TEST(SubdivisionReference, OtherAxesTakeNoPart)
{
  const auto       input = RandomGrid<2>({ 7, 3 }, 4);
  ref::Settings<2> settings;
  settings.axes = { true, false };
  const auto output = ref::Subdivide<2>(input, settings);
  for (long y = 0; y < 3; ++y)
  {
    const std::vector<double> row(input.values.begin() + 7 * y, input.values.begin() + 7 * (y + 1));
    const Line                alone = ref::Subdivide<1>(MakeLine(row), LineSettings(ref::Scheme::NonOscillatory));
    for (long x = 0; x < 14; ++x)
    {
      EXPECT_EQ(output({ x, y }), alone({ x }));
    }
  }
}

/** In 1-D the bounded scheme stays within the three voxels around the parent, and equals the linear one where that
 * already does. */
TEST(SubdivisionReference, BoundedLinearIsTheClampedLinearScheme)
{
  const Line input = RandomGrid<1>({ 15 }, 5);
  const Line linear = ref::Subdivide<1>(input, LineSettings(ref::Scheme::Linear));
  const Line bounded = ref::Subdivide<1>(input, LineSettings(ref::Scheme::BoundedLinear));
  for (long m = 2; m < 28; ++m)
  {
    const auto range = std::minmax({ input({ m / 2 - 1 }), input({ m / 2 }), input({ m / 2 + 1 }) });
    EXPECT_EQ(bounded({ m }), std::clamp(linear({ m }), range.first, range.second)) << "child " << m;
  }
}

/** At a plain edge in 3-D, every threshold next to it vanishes: the range is kept although the data jumps. */
TEST(SubdivisionReference, RangeIsKeptAtEdgesInThreeDimensions)
{
  const auto cube = ref::MakeGrid<3>(
    {}, { 14, 14, 14 }, [](const ref::Index<3> & i) { return i[0] >= 7 && i[1] >= 7 && i[2] >= 7 ? 1.0 : 0.0; });
  const auto output = ref::Subdivide<3>(cube, {});
  EXPECT_EQ(*std::min_element(output.values.begin(), output.values.end()), 0.0);
  EXPECT_EQ(*std::max_element(output.values.begin(), output.values.end()), 1.0);
}

TEST(SubdivisionReference, Boundaries)
{
  const Line line = MakeLine({ 1, 2, 3 });
  const auto around = [&](const ref::Boundary<1> & boundary) {
    std::vector<double> values;
    for (long i = -4; i < 8; ++i)
    {
      values.push_back(boundary(line, { i }));
    }
    return values;
  };
  EXPECT_EQ(around(ref::ZeroFlux<1>()), (std::vector<double>{ 1, 1, 1, 1, 1, 2, 3, 3, 3, 3, 3, 3 }));
  EXPECT_EQ(around(ref::Periodic<1>()), (std::vector<double>{ 3, 1, 2, 3, 1, 2, 3, 1, 2, 3, 1, 2 }));
  EXPECT_EQ(around(ref::Mirror<1>()), (std::vector<double>{ 3, 3, 2, 1, 1, 2, 3, 3, 2, 1, 1, 2 }));
  EXPECT_EQ(around(ref::Constant<1>(9)), (std::vector<double>{ 9, 9, 9, 9, 1, 2, 3, 9, 9, 9, 9, 9 }));
}
