// SPDX-License-Identifier: Apache-2.0

// Label maps against an election held by the slow reference: every label of the image votes everywhere.

#include "NonOscillatorySubdivision/LabelSubdivider.h"
#include "SubdividerTestHelpers.h"
#include "common/SubdivisionReference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace
{

using namespace itk::Subdivision;
namespace ref = SubdivisionReference;

template <unsigned int D>
using Labels = std::map<ref::Index<D>, std::int64_t>;

/** What the tests choose at random. */
template <unsigned int D>
struct LabelCase
{
  ref::Index<D>    Start;
  ref::Index<D>    Size;
  Labels<D>        Map;
  ref::Settings<D> Settings;
  Options          What;
};

ref::Scheme
ToReference(const Scheme & scheme)
{
  return scheme.IsSharpened              ? ref::Scheme::Restored
         : scheme.Values == Mask::Linear ? ref::Scheme::Linear
                                         : ref::Scheme::BSpline;
}

/** The winners by the rules of docs/scheme.md, section 6. */
template <unsigned int D>
Labels<D>
HoldElection(const LabelCase<D> & test)
{
  std::set<std::int64_t> all;
  for (const auto & voxel : test.Map)
  {
    all.insert(voxel.second);
  }
  ref::Index<D> start = test.Start;
  ref::Index<D> size = test.Size;
  for (unsigned int w = 0; w < D; ++w)
  {
    start[w] *= test.Settings.axes[w] ? 2 : 1;
    size[w] *= test.Settings.axes[w] ? 2 : 1;
  }
  Labels<D>                       winners;
  std::map<ref::Index<D>, double> most;
  for (const std::int64_t label : all)
  {
    const auto indicator = ref::MakeGrid<D>(
      test.Start, test.Size, [&](const ref::Index<D> & index) { return test.Map.at(index) == label ? 1.0 : 0.0; });
    const ref::Subdivision<D> votes(indicator, test.Settings);
    ref::ForEachIndex<D>(start, size, [&](const ref::Index<D> & child) {
      ref::Index<D> parent = child;
      for (unsigned int w = 0; w < D; ++w)
      {
        parent[w] =
          test.Settings.axes[w] ? ref::FloorModulo(child[w], 2) == 0 ? child[w] / 2 : (child[w] - 1) / 2 : child[w];
      }
      ref::Index<D> fromStart = child;
      for (unsigned int w = 0; w < D; ++w)
      {
        fromStart[w] -= start[w];
      }
      const double vote = votes.At(fromStart);
      const bool   isFirst = winners.count(child) == 0;
      if (isFirst || vote > most[child] || (vote == most[child] && test.Map.at(parent) == label))
      {
        most[child] = vote;
        winners[child] = label;
      }
    });
  }
  return winners;
}

template <unsigned int D>
TestArray::Box
ToBox(const ref::Index<D> & start, const ref::Index<D> & size)
{
  TestArray::Box box;
  for (unsigned int w = 0; w < D; ++w)
  {
    box.push_back({ start[w], static_cast<std::uint64_t>(size[w]) });
  }
  return box;
}

template <unsigned int D>
TestArray::Index
ToArrayIndex(const ref::Index<D> & index)
{
  return TestArray::Index(index.begin(), index.end());
}

template <unsigned int D>
TestArray
MakeArray(const LabelCase<D> & test, const ElementType type)
{
  TestArray array(type, ToBox<D>(test.Start, test.Size));
  for (const auto & voxel : test.Map)
  {
    array.Set(ToArrayIndex<D>(voxel.first), static_cast<double>(voxel.second));
  }
  return array;
}

void
Compute(const TestArray & input, const TestArray::Box & whole, TestArray & output, const Options & options)
{
  CountingMonitor monitor;
  LabelSubdivider run(input.View(), whole, output.View(), options);
  RunTiles(run, 2, monitor);
  EXPECT_EQ(monitor.GetElements(), CountElements(output.GetBox()));
}

/** Some balls of labels in a background, and a few single voxels. */
template <unsigned int D>
LabelCase<D>
MakeCase(std::mt19937 & random, const char * const scheme, const long longest)
{
  LabelCase<D> test;
  for (unsigned int w = 0; w < D; ++w)
  {
    test.Start[w] = static_cast<long>(random() % 9) - 4;
    test.Size[w] = 1 + static_cast<long>(random() % static_cast<unsigned long>(longest));
    test.Settings.axes[w] = random() % 4 != 0 && w < 3; // three axes at most
  }
  const long labels = 2 + static_cast<long>(random() % 4);
  struct Ball
  {
    std::array<double, D> Centre;
    double                Radius;
  };
  std::vector<Ball> balls(5);
  for (Ball & ball : balls)
  {
    ball.Radius = 1.0 + random() % 5;
    for (unsigned int w = 0; w < D; ++w)
    {
      ball.Centre[w] = static_cast<double>(test.Start[w]) + static_cast<double>(random() % 1000) / 1000 * test.Size[w];
    }
  }
  ref::ForEachIndex<D>(test.Start, test.Size, [&](const ref::Index<D> & index) {
    std::int64_t label = 0;
    for (std::size_t i = 0; i < balls.size(); ++i)
    {
      double square = 0;
      for (unsigned int w = 0; w < D; ++w)
      {
        square += (index[w] - balls[i].Centre[w]) * (index[w] - balls[i].Centre[w]);
      }
      label = square < balls[i].Radius * balls[i].Radius ? 1 + static_cast<std::int64_t>(i) % labels : label;
    }
    test.Map[index] = random() % 30 == 0 ? static_cast<std::int64_t>(random() % 3) : label;
  });

  test.What.Scheme = &FindScheme(scheme);
  test.Settings.scheme = ToReference(*test.What.Scheme);
  test.Settings.tension = test.What.Tension = test.What.Scheme->IsSharpened ? 0.0 : 2.0;
  test.What.SubdividedAxes.assign(test.Settings.axes.begin(), test.Settings.axes.end());
  switch (random() % 3)
  {
    case 0:
      test.Settings.boundary = ref::Mirror<D>();
      test.What.Boundary = Boundary::Mirror();
      break;
    case 1:
      test.Settings.boundary = ref::Periodic<D>();
      test.What.Boundary = Boundary::Periodic();
      break;
    default:
      break;
  }
  return test;
}

template <unsigned int D>
void
ExpectElected(const LabelCase<D> & test)
{
  const TestArray      input = MakeArray<D>(test, ElementType::UInt8);
  const TestArray::Box whole = ToBox<D>(test.Start, test.Size);
  TestArray            output(ElementType::Int32, Subdivider::GetWholeOutput(whole, test.What.SubdividedAxes));
  Compute(input, whole, output, test.What);
  for (const auto & child : HoldElection<D>(test))
  {
    ASSERT_EQ(output.Get(ToArrayIndex<D>(child.first)), static_cast<double>(child.second));
  }
}

class LabelSubdividerSchemes : public testing::TestWithParam<const char *>
{};

TEST_P(LabelSubdividerSchemes, ElectAsTheReferenceDoes)
{
  std::mt19937 random(711);
  for (int i = 0; i < 40; ++i)
  {
    ExpectElected<1>(MakeCase<1>(random, GetParam(), 40));
    ExpectElected<2>(MakeCase<2>(random, GetParam(), 14));
  }
  for (int i = 0; i < 6; ++i)
  {
    ExpectElected<3>(MakeCase<3>(random, GetParam(), 9));
    ExpectElected<4>(MakeCase<4>(random, GetParam(), 4));
  }
}

INSTANTIATE_TEST_SUITE_P(All, LabelSubdividerSchemes, testing::Values("restored", "bspline", "linear"));

/** A map larger than some blocks: balls of labels without an end. */
TestArray
MakeLargeMap(const TestArray::Box & box)
{
  TestArray labels(ElementType::UInt16, box);
  TestArray::ForEachIndex(box, [&](const TestArray::Index & index) {
    const auto wave = [&](const int axis, const double length) {
      return std::sin(static_cast<double>(index[axis]) / length);
    };
    const double sum = wave(0, 7.0) + wave(1, 5.0) + wave(2, 6.0);
    labels.Set(index, sum > 1.2 ? 1007.0 : sum < -1.0 ? 3.0 : wave(0, 40.0) > 0.5 ? 7.0 : 0.0);
  });
  return labels;
}

TEST(LabelSubdivider, PartsAreThoseOfTheWhole)
{
  const TestArray::Box box{ { -3, 150 }, { 5, 60 }, { 0, 55 } };
  const TestArray      labels = MakeLargeMap(box);
  Options              options = LabelSubdivider::GetDefaultOptions();
  options.SubdividedAxes = { true, true, true };
  TestArray whole(ElementType::UInt16, Subdivider::GetWholeOutput(box, options.SubdividedAxes));
  Compute(labels, box, whole, options);

  std::mt19937 random(5);
  for (int i = 0; i < 8; ++i)
  {
    TestArray::Box part = whole.GetBox();
    for (Interval & interval : part)
    {
      const auto offset = static_cast<std::int64_t>(random() % (interval.Size - 1));
      interval = { interval.First + offset, 1 + random() % (interval.Size - static_cast<std::uint64_t>(offset)) };
    }
    const TestArray needed =
      Cut(labels, Subdivider::GetInputRequest(part, box, options), TestLayout::Dense(box.size()));
    TestArray output(ElementType::UInt16, part);
    Compute(needed, box, output, options);
    TestArray::ForEachIndex(part,
                            [&](const TestArray::Index & index) { ASSERT_EQ(output.Get(index), whole.Get(index)); });
  }
}

TEST(LabelSubdivider, NoTargetElectsAnotherLabel)
{
  const TestArray::Box box{ { 0, 70 }, { 0, 40 }, { 0, 30 } };
  const TestArray      labels = MakeLargeMap(box);
  Options              options = LabelSubdivider::GetDefaultOptions();
  options.SubdividedAxes = { true, true, true };
  const TestArray::Box outputBox = Subdivider::GetWholeOutput(box, options.SubdividedAxes);
  for (const char * const scheme : { "restored", "bspline", "linear" })
  {
    options.Scheme = &FindScheme(scheme);
    options.Tension = options.Scheme->IsSharpened ? 0.0 : 2.0;
    options.Target = &Target::Named("portable");
    TestArray portable(ElementType::UInt16, outputBox);
    Compute(labels, box, portable, options);
    for (const std::string & name : Target::GetNames())
    {
      options.Target = &Target::Named(name);
      TestArray output(ElementType::UInt16, outputBox);
      Compute(labels, box, output, options);
      TestArray::ForEachIndex(
        outputBox, [&](const TestArray::Index & index) { ASSERT_EQ(output.Get(index), portable.Get(index)) << name; });
    }
  }
}

TEST(LabelSubdivider, OnlyLabelsThatAreThereAndAllOfThem)
{
  const TestArray::Box box{ { 0, 40 }, { 0, 30 }, { 0, 20 } };
  const TestArray      labels = MakeLargeMap(box);
  std::set<double>     before;
  std::set<double>     after;
  Options              options = LabelSubdivider::GetDefaultOptions();
  options.SubdividedAxes = { true, true, true };
  TestArray output(ElementType::UInt16, Subdivider::GetWholeOutput(box, options.SubdividedAxes));
  Compute(labels, box, output, options);
  TestArray::ForEachIndex(box, [&](const TestArray::Index & index) { before.insert(labels.Get(index)); });
  TestArray::ForEachIndex(output.GetBox(), [&](const TestArray::Index & index) { after.insert(output.Get(index)); });
  EXPECT_EQ(before, after);
  EXPECT_EQ(before.count(1007.0), 1u);
}

TEST(LabelSubdivider, OfTwoEqualVotesTheLowerLabelWins)
{
  // Two labels that mirror each other at the diagonal, which has a third one but for the voxel in the middle.
  const TestArray::Box box{ { 0, 12 }, { 0, 12 } };
  for (const double right : { 20.0, 60.0 })
  {
    const double left = 80.0 - right;
    TestArray    labels(ElementType::UInt8, box);
    TestArray::ForEachIndex(box, [&](const TestArray::Index & index) {
      const bool isMiddle = index[0] == 6 && index[1] == 6;
      labels.Set(index, isMiddle ? 90.0 : index[0] == index[1] ? 100.0 : index[0] > index[1] ? right : left);
    });
    Options options;
    options.Scheme = &FindScheme("bspline");
    options.SubdividedAxes = { true, true };
    TestArray output(ElementType::UInt8, { { 0, 24 }, { 0, 24 } });
    Compute(labels, box, output, options);
    EXPECT_EQ(output.Get({ 12, 12 }), 20.0);
    EXPECT_EQ(output.Get({ 13, 13 }), 20.0);
    EXPECT_EQ(output.Get({ 13, 12 }), right);
    EXPECT_EQ(output.Get({ 12, 13 }), left);
  }
}

TEST(LabelSubdivider, FullRangeOfLabels)
{
  const TestArray::Box       box{ { 0, 8 } };
  std::vector<std::uint64_t> labels{ 0, 0, 0, ~std::uint64_t{ 0 }, ~std::uint64_t{ 0 } - 1, 5, 5, 5 };
  std::vector<std::uint64_t> output(16);
  Options                    options = LabelSubdivider::GetDefaultOptions();
  options.SubdividedAxes = { true };
  const ConstArrayView in{ labels.data(), ElementType::UInt64, { { 0, 8, 1 } } };
  CountingMonitor      monitor;
  {
    LabelSubdivider run(in, box, { output.data(), ElementType::UInt64, { { 0, 16, 1 } } }, options);
    RunTiles(run, 1, monitor);
    EXPECT_EQ(output[6], ~std::uint64_t{ 0 });
    EXPECT_EQ(output[9], ~std::uint64_t{ 0 } - 1);
  }
  LabelSubdivider run(in, box, { output.data(), ElementType::Int64, { { 0, 16, 1 } } }, options);
  EXPECT_THROW(RunTiles(run, 1, monitor), std::range_error);
}

/** A boundary supplies doubles, several integers of which would be one from 2^53 on. */
TEST(LabelSubdivider, LabelsOfTheBoundaryAreExact)
{
  const TestArray::Box             box{ { 0, 1 } };
  const std::vector<std::uint64_t> labels{ 7 };
  std::vector<std::uint64_t>       output(2);
  const ConstArrayView             in{ labels.data(), ElementType::UInt64, { { 0, 1, 1 } } };
  const ArrayView                  out{ output.data(), ElementType::UInt64, { { 0, 2, 1 } } };
  Options                          options = LabelSubdivider::GetDefaultOptions();
  options.SubdividedAxes = { true };
  CountingMonitor monitor;
  const double    largest = 9007199254740991.0;
  options.Boundary = Boundary::Constant({ largest });
  LabelSubdivider exact(in, box, out, options);
  EXPECT_NO_THROW(RunTiles(exact, 1, monitor));
  for (const double constant : { largest + 1.0, std::ldexp(1.0, 63) })
  {
    options.Boundary = Boundary::Constant({ constant });
    LabelSubdivider run(in, box, out, options);
    EXPECT_THROW(RunTiles(run, 1, monitor), std::range_error) << constant;
  }
}

TEST(LabelSubdivider, SchemesWithoutATensionIgnoreIt)
{
  const TestArray::Box box{ { 0, 9 } };
  TestArray            labels(ElementType::UInt8, box);
  TestArray::ForEachIndex(box, [&](const TestArray::Index & index) { labels.Set(index, index[0] < 4 ? 3.0 : 8.0); });
  for (const char * const scheme : { "bspline", "linear" })
  {
    Options options = LabelSubdivider::GetDefaultOptions();
    options.Scheme = &FindScheme(scheme);
    options.SubdividedAxes = { true };
    TestArray output(ElementType::UInt8, { { 0, 18 } });
    Compute(labels, box, output, options);
    TestArray::ForEachIndex(output.GetBox(), [&](const TestArray::Index & index) {
      EXPECT_EQ(output.Get(index), index[0] < 8 ? 3.0 : 8.0) << scheme << index[0];
    });
  }
}

TEST(LabelSubdivider, RefusesWhatIsNoLabelMap)
{
  const TestArray::Box box{ { 0, 8 } };
  const TestArray      labels(ElementType::UInt8, box);
  const TestArray      real(ElementType::Float, box);
  TestArray            output(ElementType::UInt8, { { 0, 16 } });
  Options              options = LabelSubdivider::GetDefaultOptions();
  options.SubdividedAxes = { true };
  EXPECT_THROW(LabelSubdivider(real.View(), box, output.View(), options), std::invalid_argument);
  for (const char * const scheme : { "nonoscillatory", "bounded" })
  {
    options.Scheme = &FindScheme(scheme);
    options.Tension = 2.0;
    EXPECT_THROW(LabelSubdivider(labels.View(), box, output.View(), options), std::invalid_argument);
  }
  options = LabelSubdivider::GetDefaultOptions();
  EXPECT_THROW(LabelSubdivider(labels.View(), box, output.View(), options), std::invalid_argument);
  options.SubdividedAxes = { true };
  options.Boundary = Boundary::Constant({ 0.5 });
  LabelSubdivider half(labels.View(), box, output.View(), options);
  CountingMonitor monitor;
  EXPECT_THROW(RunTiles(half, 1, monitor), std::range_error);
}

} // namespace
