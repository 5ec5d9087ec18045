// SPDX-License-Identifier: Apache-2.0

// What holds of any label map, on generated runs.

#include "common/GeneratedCases.h"
#include "NonOscillatorySubdivision/Geometry.h"
#include "NonOscillatorySubdivision/LabelSubdivider.h"
#include "RandomRun.h"

namespace
{

using namespace itk::Subdivision;
using Index = TestArray::Index;

/** A run of labels in lumps, of a random integer type. */
class LabelRun : public RandomRun
{
public:
  explicit LabelRun(const unsigned int seed)
    : RandomRun(seed, 4, 700)
    , Type(static_cast<ElementType>(this->Below(8)))
    , Map(Type, Whole)
  {
    constexpr unsigned int schemes[] = { 1, 3, 4 };
    this->SetScheme(schemes[this->Below(3)]);
    What.Tension = What.Scheme->HasTension() ? 0.0 : 2.0;
    this->SetBoundary(static_cast<BoundaryKind>(this->Below(3)));
    const unsigned int labels = 2 + this->Below(4);
    double             label = 0;
    TestArray::ForEachIndex(Whole, [&](const Index & index) {
      label = this->Below(4) == 0 ? static_cast<double>(this->Below(labels)) : label;
      Map.Set(index, label);
    });
  }

  TestArray
  Elect(const TestArray & map) const
  {
    return this->Elect(map, What);
  }

  static TestArray
  Elect(const TestArray & map, const Options & options)
  {
    TestArray       output(map.GetType(), Subdivider::GetWholeOutput(map.GetBox(), options.SubdividedAxes));
    CountingMonitor monitor;
    LabelSubdivider run(map.View(), map.GetBox(), output.View(), options);
    RunTiles(run, 1, monitor);
    return output;
  }

  const ElementType Type;
  TestArray         Map;
};

template <typename TExpected>
void
ExpectLabels(const TestArray & output, const TExpected & expected)
{
  std::size_t wrong = 0;
  TestArray::ForEachIndex(output.GetBox(),
                          [&](const Index & index) { wrong += output.Get(index) != expected(index) ? 1 : 0; });
  EXPECT_EQ(wrong, 0u) << "of " << CountElements(output.GetBox()) << " labels";
}

template <typename TCheck>
void
ForEachLabelRun(const TCheck & check)
{
  ForEachGeneratedCase(150, [&](const unsigned int seed) {
    LabelRun run(seed);
    SCOPED_TRACE(run.Describe() + ", " + GetName(run.Type));
    check(run);
  });
}

TEST(LabelSubdividerProperties, NoLabelFromOutsideTheStencil)
{
  ForEachLabelRun([](LabelRun & run) {
    const TestArray output = run.Elect(run.Map);
    std::size_t     strange = 0;
    // Some children, since the stencils of all would take seconds.
    for (int i = 0; i < 30; ++i)
    {
      Index child;
      for (const Interval & interval : output.GetBox())
      {
        child.push_back(interval.First + run.Below(interval.Size));
      }
      Box stencil;
      for (std::size_t axis = 0; axis < child.size(); ++axis)
      {
        stencil.push_back(run.What.SubdividedAxes[axis] ? GetStencil({ child[axis], 1 }, run.What.Scheme->Radius())
                                                        : Interval{ child[axis], 1 });
      }
      bool isThere = false;
      TestArray::ForEachIndex(stencil, [&](Index voxel) {
        for (std::size_t axis = 0; axis < voxel.size(); ++axis)
        {
          const auto         size = static_cast<std::int64_t>(run.Whole[axis].Size);
          const std::int64_t position = voxel[axis] - run.Whole[axis].First;
          const bool         isInside = position >= 0 && position < size;
          voxel[axis] = isInside ? voxel[axis] : run.Whole[axis].First + run.What.Boundary.MapIndex(position, size);
        }
        isThere = isThere || run.Map.Get(voxel) == output.Get(child);
      });
      strange += isThere ? 0 : 1;
    }
    EXPECT_EQ(strange, 0u);
  });
}

/** Other names for the labels in the same order: the same children by their new names. */
TEST(LabelSubdividerProperties, RenamedLabelsAreElectedByTheirNewNames)
{
  ForEachLabelRun([](LabelRun & run) {
    const TestArray output = run.Elect(run.Map);
    const double    lowest = run.Below(2) == 0 ? 3.0 : 0.0;
    const auto      rename = [lowest](const double label) { return lowest + label * (label + 3); };
    TestArray       renamed = run.Map;
    TestArray::ForEachIndex(run.Whole, [&](const Index & index) { renamed.Set(index, rename(run.Map.Get(index))); });
    ExpectLabels(run.Elect(renamed), [&](const Index & index) { return rename(output.Get(index)); });
  });
}

/** Votes are exact, so that neither flips nor the order of axes changes a single label. */
TEST(LabelSubdividerProperties, FlipsAndPermutationsCommute)
{
  ForEachLabelRun([](LabelRun & run) {
    const std::size_t        axes = run.Whole.size();
    std::vector<std::size_t> order = TestLayout::Dense(axes).Order;
    std::shuffle(order.begin(), order.end(), run.Random);
    Flags   flipped;
    Box     box;
    Options options = run.What;
    options.SubdividedAxes.clear();
    for (const std::size_t axis : order)
    {
      flipped.push_back(run.Below(2) == 0);
      box.push_back(run.Whole[axis]);
      options.SubdividedAxes.push_back(run.What.SubdividedAxes[axis]);
    }
    const auto toOriginal = [&](const Box & of, const Index & index) {
      Index original(axes);
      for (std::size_t axis = 0; axis < axes; ++axis)
      {
        const std::int64_t last = of[axis].First + static_cast<std::int64_t>(of[axis].Size) - 1;
        original[order[axis]] = flipped[axis] ? of[axis].First + last - index[axis] : index[axis];
      }
      return original;
    };
    TestArray turned(run.Type, box);
    TestArray::ForEachIndex(box, [&](const Index & index) { turned.Set(index, run.Map.Get(toOriginal(box, index))); });
    const TestArray output = run.Elect(run.Map);
    const TestArray turnedOutput = LabelRun::Elect(turned, options);
    ExpectLabels(turnedOutput,
                 [&](const Index & index) { return output.Get(toOriginal(turnedOutput.GetBox(), index)); });
  });
}

/** Part by part, with any number of threads, by any target, into any integer type. */
TEST(LabelSubdividerProperties, PartsHaveTheLabelsOfTheWhole)
{
  ForEachLabelRun([](LabelRun & run) {
    const TestArray whole = run.Elect(run.Map);
    const Box       box = run.MakeBox(whole.GetBox());
    const TestArray needed = Cut(run.Map, Subdivider::GetInputRequest(box, run.Whole, run.What), run.MakeLayout());
    const auto      targets = Target::GetNames();
    run.What.Target = &Target::Named(targets[run.Below(targets.size())]);
    TestArray       part(static_cast<ElementType>(run.Below(8)), box, run.MakeLayout());
    CountingMonitor monitor;
    LabelSubdivider labels(needed.View(), run.Whole, part.View(), run.What);
    RunTiles(labels, 1 + run.Below(4), monitor);
    EXPECT_EQ(monitor.GetElements(), CountElements(box));
    ExpectLabels(part, [&](const Index & index) { return whole.Get(index); });
  });
}

} // namespace
