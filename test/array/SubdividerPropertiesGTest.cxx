// SPDX-License-Identifier: Apache-2.0

// What holds of any input, on generated runs from array to array: symmetries, what is reproduced, what is never left.

#include "common/GeneratedCases.h"
#include "RandomRun.h"

#include <cmath>
#include <functional>

namespace
{

using namespace itk::Subdivision;
using BoundaryKind = RandomRun::BoundaryKind;
using Index = TestArray::Index;

constexpr std::size_t   MostAxes = 4;
constexpr std::uint64_t MostElements = 1500;

/** A run of real values, whose boundary follows a rule that has no preferred place or direction. */
class SymmetricRun : public RandomRun
{
public:
  explicit SymmetricRun(const unsigned int seed)
    : RandomRun(seed, MostAxes, MostElements)
    , Type(this->MakeRealType())
  {
    this->SetBoundary(static_cast<BoundaryKind>(this->Below(4)));
  }

  /** Integers of 8 bits, which leave both real types digits, or any values; spikes now and then. */
  TestArray
  MakeValues()
  {
    TestArray                              values = this->MakeInput(Type);
    std::uniform_real_distribution<double> noise(-100, 100);
    const bool                             isNoise = this->Below(2) == 0;
    TestArray::ForEachIndex(Whole, [&](const Index & index) {
      if (isNoise || Random() % 50 == 0)
      {
        values.Set(index, noise(Random));
      }
    });
    return values;
  }

  double
  GetEpsilon() const
  {
    return static_cast<double>(Type == ElementType::Float ? std::numeric_limits<float>::epsilon()
                                                          : std::numeric_limits<double>::epsilon());
  }

  const ElementType Type;
};

using IndexMap = std::function<Index(const Index &)>;

/** An array whose element at an index is that of another array at the index that a map gives. */
TestArray
Mapped(const TestArray & from, const Box & box, const IndexMap & map)
{
  TestArray to(from.GetType(), box);
  TestArray::ForEachIndex(box, [&](const Index & index) { to.Set(index, from.Get(map(index))); });
  return to;
}

/** Of each element, the least and the greatest value that it may have, but for \c slack. Tells of the first that has
 * not. */
template <typename TRange>
void
ExpectRanges(const TestArray & output, const double slack, const TRange & rangeOf)
{
  bool isFirst = true;
  TestArray::ForEachIndex(output.GetBox(), [&](const Index & index) {
    const auto [low, high] = rangeOf(index);
    const double value = output.Get(index);
    if (isFirst && !(value >= low - slack && value <= high + slack))
    {
      isFirst = false;
      ADD_FAILURE() << value << " where " << low << " ... " << high << " is right up to " << slack << ", at "
                    << testing::PrintToString(index);
    }
  });
}

template <typename TExpected>
void
ExpectEach(const TestArray & output, const double tolerance, const TExpected & expected)
{
  ExpectRanges(output, tolerance, [&](const Index & index) {
    const double value = expected(index);
    return std::make_pair(value, value);
  });
}

template <typename TCheck>
void
ForEachSymmetricRun(const TCheck & check)
{
  ForEachGeneratedCase(250, [&](const unsigned int seed) {
    SymmetricRun run(seed);
    SCOPED_TRACE(run.Describe() + ", " + GetName(run.Type));
    check(run);
  });
}

/** The last index along an axis of a box, counted so that a flip takes it to the first. */
IndexMap
FlipOf(const Box & box, const Flags & flipped)
{
  return [box, flipped](Index index) {
    for (std::size_t axis = 0; axis < index.size(); ++axis)
    {
      if (flipped[axis])
      {
        index[axis] = 2 * box[axis].First + static_cast<std::int64_t>(box[axis].Size) - 1 - index[axis];
      }
    }
    return index;
  };
}

/** Both children of a voxel share their sums but for a sign: flips change no bit. */
TEST(SubdividerProperties, FlipsOfTheInputFlipTheOutput)
{
  ForEachSymmetricRun([](SymmetricRun & run) {
    Flags flipped;
    while (flipped.size() < run.Whole.size())
    {
      flipped.push_back(run.Below(2) == 0);
    }
    const TestArray input = run.MakeValues();
    const TestArray output = run.Subdivide(input);
    const IndexMap  flip = FlipOf(output.GetBox(), flipped);
    ExpectEach(run.Subdivide(Mapped(input, run.Whole, FlipOf(run.Whole, flipped))), 0.0, [&](const Index & index) {
      return output.Get(flip(index));
    });
  });
}

/** Which axis is named first makes no difference at all where memory says in which order they lie, which it does not
 * along axes of size 1; which one lies first in memory is the one that is summed first, and so makes one in the last
 * places. */
TEST(SubdividerProperties, PermutedAxesPermuteTheOutput)
{
  ForEachSymmetricRun([](SymmetricRun & run) {
    const std::size_t        axes = run.Whole.size();
    std::vector<std::size_t> order = TestLayout::Dense(axes).Order;
    std::shuffle(order.begin(), order.end(), run.Random);
    Box     box;
    Options options = run.What;
    options.SubdividedAxes.clear();
    TestLayout sameMemory = TestLayout::Dense(axes);
    for (std::size_t axis = 0; axis < axes; ++axis)
    {
      box.push_back(run.Whole[order[axis]]);
      options.SubdividedAxes.push_back(run.What.SubdividedAxes[order[axis]]);
      sameMemory.Order[order[axis]] = axis;
    }
    const IndexMap toOriginal = [&order](const Index & index) {
      Index original(index.size());
      for (std::size_t axis = 0; axis < index.size(); ++axis)
      {
        original[order[axis]] = index[axis];
      }
      return original;
    };
    const TestArray input = run.MakeValues();
    const TestArray output = run.Subdivide(input);
    const auto      expected = [&](const Index & index) { return output.Get(toOriginal(index)); };

    const TestArray transposed = Mapped(input, box, toOriginal);
    const TestArray renamed = Cut(transposed, box, sameMemory);
    // The restored scheme's limit is a quotient of two variations, which at these tensions is up to 64 times as
    // sensitive as they are.
    const double units = run.What.Scheme->Limited == Correction::TowardsLinear ? 256 : 16;
    const double tolerance = units * run.GetEpsilon() * 128;
    const bool   isOrdered =
      std::none_of(box.begin(), box.end(), [](const Interval & interval) { return interval.Size == 1; });
    ExpectEach(RandomRun::Subdivide(renamed, options), isOrdered ? 0.0 : tolerance, expected);
    ExpectEach(RandomRun::Subdivide(transposed, options), tolerance, expected);
  });
}

/** Powers of two, of either sign, change no digit, as long as nothing overflows or becomes denormal. */
TEST(SubdividerProperties, ScalingByAPowerOfTwoScalesTheOutput)
{
  ForEachSymmetricRun([](SymmetricRun & run) {
    const double        factor = std::ldexp(run.Below(2) == 0 ? 1.0 : -1.0, static_cast<int>(run.Below(121)) - 60);
    const TestArray     input = run.MakeValues();
    const TestArray     output = run.Subdivide(input);
    TestArray           scaled = input;
    std::vector<double> constants = run.What.Boundary.GetConstants();
    TestArray::ForEachIndex(run.Whole, [&](const Index & index) { scaled.Set(index, factor * input.Get(index)); });
    if (!constants.empty())
    {
      constants[0] *= factor;
      run.What.Boundary = Boundary::Constant(constants);
    }
    ExpectEach(run.Subdivide(scaled), 0.0, [&](const Index & index) { return factor * output.Get(index); });
  });
}

/** In double, small integers leave every sum exact, so that a constant that is added comes out again to the bit; but
 * for the quotient of the restored scheme with a tension, which is rounded, and for float. */
TEST(SubdividerProperties, AddingAConstantAddsItToTheOutput)
{
  ForEachSymmetricRun([](SymmetricRun & run) {
    const double        constant = static_cast<double>(run.Below(201)) - 100.0;
    const TestArray     input = run.MakeInput(run.Type);
    const TestArray     output = run.Subdivide(input);
    TestArray           shifted = input;
    std::vector<double> constants = run.What.Boundary.GetConstants();
    TestArray::ForEachIndex(run.Whole, [&](const Index & index) { shifted.Set(index, input.Get(index) + constant); });
    if (!constants.empty())
    {
      constants[0] += constant;
      run.What.Boundary = Boundary::Constant(constants);
    }
    const bool   isRestored = run.What.Scheme->Limited == Correction::TowardsLinear;
    const bool   isExact = run.Type == ElementType::Double && run.What.Tension != 1.01 && !isRestored;
    const double tolerance = isExact ? 0.0 : (isRestored ? 256 : 16) * run.GetEpsilon() * 256;
    ExpectEach(run.Subdivide(shifted), tolerance, [&](const Index & index) { return output.Get(index) + constant; });
  });
}

/** Integers of 16 bits come out again exactly in double, any constant under the schemes that are bounded, and up to
 * four units in the last place otherwise. */
TEST(SubdividerProperties, ConstantsAreReproduced)
{
  ForEachSymmetricRun([](SymmetricRun & run) {
    run.SetBoundary(static_cast<BoundaryKind>(run.Below(3)));
    const bool isInteger = run.Below(2) == 0;
    double     constant = static_cast<double>(run.Below(65536)) - 32768.0 + (isInteger ? 0.0 : 1.0 / 3.0);
    constant = run.Type == ElementType::Float ? static_cast<double>(static_cast<float>(constant)) : constant;
    TestArray input(run.Type, run.Whole);
    TestArray::ForEachIndex(run.Whole, [&](const Index & index) { input.Set(index, constant); });
    const bool   isExact = run.What.Scheme->IsBounded || (isInteger && run.Type == ElementType::Double);
    const double tolerance = isExact ? 0.0 : 4 * run.GetEpsilon() * std::abs(constant);
    ExpectEach(run.Subdivide(input), tolerance, [&](const Index &) { return constant; });
  });
}

/** Away from the border, the children of a ramp lie on it: exactly in double, where its values are small integers. */
TEST(SubdividerProperties, RampsAreReproduced)
{
  ForEachSymmetricRun([](SymmetricRun & run) {
    // Wide enough that something lies away from the border.
    const std::int64_t radius = run.What.Scheme->Radius();
    std::int64_t       most = 24;
    for (std::size_t axis = 0; axis < run.Whole.size(); ++axis)
    {
      const bool isSubdivided = run.What.SubdividedAxes[axis];
      run.Whole[axis].Size = isSubdivided ? static_cast<std::uint64_t>(2 * radius) + 1 + run.Below(most) : 2;
      most = isSubdivided ? std::max<std::int64_t>(most / 8, 1) : most;
    }
    const double        start = static_cast<double>(run.Below(200)) - 100.0;
    std::vector<double> slopes;
    while (slopes.size() < run.Whole.size())
    {
      slopes.push_back(static_cast<double>(run.Below(9)) - 4.0);
    }
    const auto valueAt = [&](const auto & position) {
      double value = start;
      for (std::size_t axis = 0; axis < slopes.size(); ++axis)
      {
        value += slopes[axis] * (position(axis) - static_cast<double>(run.Whole[axis].First));
      }
      return value;
    };
    TestArray input(run.Type, run.Whole);
    TestArray::ForEachIndex(run.Whole, [&](const Index & index) {
      input.Set(index, valueAt([&](const std::size_t axis) { return static_cast<double>(index[axis]); }));
    });
    const TestArray output = run.Subdivide(input);
    Box             inside = output.GetBox();
    for (std::size_t axis = 0; axis < inside.size(); ++axis)
    {
      if (run.What.SubdividedAxes[axis])
      {
        inside[axis] = { inside[axis].First + 2 * radius, inside[axis].Size - 4 * static_cast<std::uint64_t>(radius) };
      }
    }
    const double tolerance = run.Type == ElementType::Double ? 0.0 : 32 * run.GetEpsilon() * 600;
    ExpectEach(Cut(output, inside, TestLayout::Dense(inside.size())), tolerance, [&](const Index & index) {
      return valueAt([&](const std::size_t axis) {
        const auto child = static_cast<double>(index[axis]);
        return run.What.SubdividedAxes[axis] ? child / 2 - 0.25 : child;
      });
    });
  });
}

/** The range of the voxels around the parent of a child, from \c first to \c last along each subdivided axis for an
 * upper child; mirrored for a lower one. */
std::pair<double, double>
FindRange(const RandomRun & run, const TestArray & input, const Index & child, const int first, const int last)
{
  Box around;
  for (std::size_t axis = 0; axis < child.size(); ++axis)
  {
    const bool         isSubdivided = run.What.SubdividedAxes[axis];
    const bool         isLower = child[axis] % 2 == 0;
    const std::int64_t parent = isSubdivided ? (isLower ? child[axis] / 2 : (child[axis] - 1) / 2) : child[axis];
    const int          before = isLower ? -last : first;
    around.push_back({ parent + (isSubdivided ? before : 0),
                       isSubdivided ? static_cast<std::uint64_t>(last - first) + 1 : std::uint64_t{ 1 } });
  }
  std::pair<double, double> range{ std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
  TestArray::ForEachIndex(around, [&](Index index) {
    bool isOutside = false;
    for (std::size_t axis = 0; axis < index.size(); ++axis)
    {
      const Interval &   whole = run.Whole[axis];
      const auto         size = static_cast<std::int64_t>(whole.Size);
      const std::int64_t position = index[axis] - whole.First;
      isOutside = isOutside || position < 0 || position >= size;
      index[axis] = run.Kind == BoundaryKind::Nearest    ? whole.First + std::clamp<std::int64_t>(position, 0, size - 1)
                    : run.Kind == BoundaryKind::Periodic ? whole.First + ((position % size) + size) % size
                                                         : index[axis];
    }
    const bool   isConstant = isOutside && run.Kind == BoundaryKind::Constant;
    const double value = isConstant ? run.What.Boundary.GetConstants()[0] : input.Get(index);
    range = { std::min(range.first, value), std::max(range.second, value) };
  });
  return range;
}

/** Bounded linear, and restored without a tension, on any input and in any element type: the neighbours of the parent.
 * B-spline: its stencil of six along each axis, but for two units in the last place of real values. */
TEST(SubdividerProperties, LocalRangeIsNeverLeft)
{
  ForEachGeneratedCase(250, [](const unsigned int seed) {
    RandomRun run(seed, MostAxes, MostElements / 4);
    run.SetScheme(2 + run.Below(3));
    run.What.Tension = run.What.Scheme->Limited == Correction::TowardsLinear ? 0.0 : run.What.Tension;
    constexpr BoundaryKind kinds[] = { BoundaryKind::Nearest, BoundaryKind::Periodic, BoundaryKind::Constant };
    run.SetBoundary(kinds[run.Below(3)]);
    const TestArray input = run.MakeInput(run.MakeType());
    SCOPED_TRACE(run.Describe() + ", " + GetName(input.GetType()));
    const bool   isSpline = !run.What.Scheme->IsBounded;
    const double slack = !isSpline || IsInteger(input.GetType()) ? 0.0
                         : input.GetType() == ElementType::Float ? 256 * 2.4e-7
                                                                 : 256 * 4.5e-16;
    ExpectRanges(run.Subdivide(input), slack, [&](const Index & child) {
      return isSpline ? FindRange(run, input, child, -2, 3) : FindRange(run, input, child, -1, 1);
    });
  });
}

/** A step between two constants, across one axis or at a corner of several, in any element type: no overshoot, but for
 * two units in the last place of real values under the non-oscillatory scheme. */
TEST(SubdividerProperties, StepsNeverOvershoot)
{
  ForEachGeneratedCase(250, [](const unsigned int seed) {
    RandomRun run(seed, MostAxes, MostElements);
    run.SetScheme(run.Below(2) == 0 ? 0 : 4);
    run.What.Tension = run.Below(4) == 0 ? std::numeric_limits<double>::max() : run.What.Tension;
    // Mirrored, two voxels are a pattern of steps without an end, none of them isolated.
    const bool hasPair =
      std::any_of(run.Whole.begin(), run.Whole.end(), [](const Interval & interval) { return interval.Size == 2; });
    run.SetBoundary(hasPair || run.Below(2) == 0 ? BoundaryKind::Nearest : BoundaryKind::Mirror);
    TestArray    input(run.MakeType(), run.Whole);
    const double one = static_cast<double>(run.Below(128));
    const double other = static_cast<double>(run.Below(128));
    Index        corner;
    Flags        isUpper;
    for (const Interval & interval : run.Whole)
    {
      corner.push_back(interval.First + (run.Below(3) != 0 ? run.Below(interval.Size) : 0));
      isUpper.push_back(run.Below(2) == 0);
    }
    TestArray::ForEachIndex(run.Whole, [&](const Index & index) {
      bool isWithin = true;
      for (std::size_t axis = 0; axis < index.size(); ++axis)
      {
        isWithin = isWithin && (isUpper[axis] ? index[axis] >= corner[axis] : index[axis] <= corner[axis]);
      }
      input.Set(index, isWithin ? one : other);
    });
    SCOPED_TRACE(run.Describe() + ", " + GetName(input.GetType()));
    const bool   isExact = run.SchemeNumber == 4 || IsInteger(input.GetType());
    const double slack = isExact ? 0.0 : 256 * (input.GetType() == ElementType::Float ? 1.2e-7 : 2.3e-16);
    ExpectRanges(run.Subdivide(input), slack, [one, other](const Index &) {
      return std::make_pair(std::min(one, other), std::max(one, other));
    });
  });
}

TEST(SubdividerProperties, PeriodicMeanIsKept)
{
  ForEachSymmetricRun([](SymmetricRun & run) {
    run.SetScheme(run.Below(2) == 0 ? 1 : 3);
    run.SetBoundary(BoundaryKind::Periodic);
    const auto meanOf = [](const TestArray & array) {
      // What each addition loses is added to the next one: a plain sum would err by more than the children do.
      double sum = 0.0;
      double lost = 0.0;
      TestArray::ForEachIndex(array.GetBox(), [&](const Index & index) {
        const double next = array.Get(index) + lost;
        const double total = sum + next;
        lost = next - (total - sum);
        sum = total;
      });
      return sum / static_cast<double>(CountElements(array.GetBox()));
    };
    const TestArray input = run.MakeValues();
    // The mean of rounding errors of up to 16 units in the last place of values of up to 128.
    EXPECT_NEAR(meanOf(run.Subdivide(input)), meanOf(input), 16 * 128 * run.GetEpsilon());
  });
}

/** Part by part, with any number of threads, from and into memory of any layout: the bytes of the whole. */
TEST(SubdividerProperties, PartsHaveTheBytesOfTheWhole)
{
  ForEachGeneratedCase(500, [](const unsigned int seed) {
    RandomRun       run(seed, MostAxes, MostElements);
    const TestArray input = run.MakeInput(run.MakeType());
    TestArray       whole(run.MakeType(), run.GetWholeOutput());
    SCOPED_TRACE(run.Describe() + ", " + GetName(input.GetType()) + " to " + GetName(whole.GetType()));
    Workspace workspace;
    Subdivide(input, run.Whole, whole, run.What, 1, workspace);

    const Box  box = run.MakeBox(whole.GetBox());
    TestLayout layout = TestLayout::Dense(box.size());
    for (std::size_t axis = 0; axis < box.size(); ++axis)
    {
      layout.Free[axis] = run.Below(3);
    }
    const TestArray needed = Cut(input, Subdivider::GetInputRequest(box, run.Whole, run.What), layout);
    TestArray       part(whole.GetType(), box, run.MakeLayout());
    Subdivide(needed, run.Whole, part, run.What, 1 + run.Below(4), workspace);
    std::size_t differing = 0;
    TestArray::ForEachIndex(
      box, [&](const Index & index) { differing += part.GetBytes(index) != whole.GetBytes(index) ? 1 : 0; });
    EXPECT_EQ(differing, 0u) << "of " << CountElements(box) << " elements of a part";
  });
}

/** What a workspace keeps of a run does not show in the next one, not even where the tension alone is another. */
TEST(SubdividerProperties, AWorkspaceForgetsTheTensionBefore)
{
  ForEachSymmetricRun([](SymmetricRun & run) {
    run.SetScheme(run.Below(2) == 0 ? 0 : 4);
    const TestArray input = run.MakeValues();
    const TestArray expected = run.Subdivide(input);
    TestArray       output(run.Type, run.GetWholeOutput());
    Workspace       workspace;
    Options         before = run.What;
    before.Tension = run.Below(2) == 0 ? 100.0 : 1.001;
    Subdivide(input, run.Whole, output, before, 1, workspace);
    Subdivide(input, run.Whole, output, run.What, 1, workspace);
    ExpectEach(output, 0.0, [&](const Index & index) { return expected.Get(index); });
  });
}

} // namespace
