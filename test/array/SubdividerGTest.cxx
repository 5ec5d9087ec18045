// SPDX-License-Identifier: Apache-2.0
#include "SubdividerTestHelpers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace
{

using namespace itk::Subdivision;

Options
MakeOptions(const Flags & subdivided, const Scheme & scheme = Schemes[0])
{
  Options options;
  options.Scheme = &scheme;
  options.SubdividedAxes = subdivided;
  return options;
}

/** A filled array. */
TestArray
MakeInput(const ElementType type, const Box & box, const unsigned int seed)
{
  std::mt19937 random(seed);
  TestArray    input(type, box);
  FillWithSteps(input, random);
  return input;
}

/** All of the output, computed at once by one thread. */
TestArray
MakeWhole(const TestArray & input, const ElementType type, const Options & options)
{
  const Box whole = input.GetBox();
  TestArray output(type, Subdivider::GetWholeOutput(whole, options.SubdividedAxes));
  Workspace workspace;
  EXPECT_EQ(Subdivide(input, whole, output, options, 1, workspace), CountElements(output.GetBox()));
  return output;
}

/** The number of elements of an array whose bytes differ from those of the whole. */
std::size_t
CountDifferences(const TestArray & part, const TestArray & whole)
{
  std::size_t differences = 0;
  TestArray::ForEachIndex(part.GetBox(), [&](const TestArray::Index & index) {
    differences += part.GetBytes(index) != whole.GetBytes(index) ? 1 : 0;
  });
  return differences;
}

struct BoxCase
{
  const char * Name;
  Box          Whole;
  Flags        Subdivided;
};

/** Every role that an axis can have, over several tiles. */
const BoxCase BoxCases[] = {
  { "x", { { -3, 1100 }, { 2, 5 } }, { true, false } },
  { "y along x", { { -3, 300 }, { 2, 9 } }, { false, true } },
  { "z along x and y", { { -3, 70 }, { 2, 30 }, { 1, 12 } }, { false, false, true } },
  { "xy", { { 0, 40 }, { -7, 30 }, { 5, 4 } }, { true, true, false } },
  { "yz along x", { { 5, 60 }, { -7, 25 }, { -2, 14 } }, { false, true, true } },
  { "xyz", { { 5, 30 }, { -7, 60 }, { -2, 14 } }, { true, true, true } },
  { "xy of RGB", { { 0, 3 }, { -7, 40 }, { -2, 30 } }, { false, true, true } },
  { "xyz of RGB", { { 0, 3 }, { -7, 30 }, { -2, 14 }, { 1, 9 } }, { false, true, true, true } },
  { "z of RGB", { { 0, 3 }, { -7, 30 }, { -2, 9 }, { 1, 9 } }, { false, false, false, true } },
  { "none", { { 0, 30 }, { -7, 30 } }, { false, false } },
};

TEST(Subdivider, BoxesAreTheBytesOfTheWhole)
{
  std::mt19937 random(3);
  for (const BoxCase & boxCase : BoxCases)
  {
    SCOPED_TRACE(boxCase.Name);
    for (const Scheme & scheme : Schemes)
    {
      const Options   options = MakeOptions(boxCase.Subdivided, scheme);
      const TestArray input = MakeInput(ElementType::Float, boxCase.Whole, 1);
      const TestArray whole = MakeWhole(input, ElementType::Float, options);
      Workspace       workspace;
      for (int run = 0; run < 6; ++run)
      {
        Box        box;
        TestLayout layout = TestLayout::Dense(boxCase.Whole.size());
        for (const Interval & interval : whole.GetBox())
        {
          layout.IsReversed[box.size()] = random() % 2 == 0;
          layout.Free[box.size()] = static_cast<std::ptrdiff_t>(random() % 2);
          const std::uint64_t skipped = random() % interval.Size;
          box.push_back(
            { interval.First + static_cast<std::int64_t>(skipped), 1 + random() % (interval.Size - skipped) });
        }
        const TestArray part = Cut(input, Subdivider::GetInputRequest(box, boxCase.Whole, options), layout);
        TestArray       output(ElementType::Float, box, layout);
        Subdivide(part, boxCase.Whole, output, options, 1 + random() % 4, workspace);
        EXPECT_EQ(CountDifferences(output, whole), 0u) << scheme.Name;
      }
    }
  }
}

TEST(Subdivider, WritesNothingBesideItsElements)
{
  const TestArray input = MakeInput(ElementType::UInt8, { { 0, 40 }, { 0, 20 } }, 1);
  TestLayout      layout = TestLayout::Dense(2);
  layout.Free = { 5, 7 };
  TestArray output(ElementType::UInt8, { { 1, 77 }, { 3, 30 } }, layout);
  Workspace workspace;
  Subdivide(input, input.GetBox(), output, MakeOptions({ true, true }), 2, workspace);
  // Steps of at most 127 give no element the value that untouched bytes have.
  EXPECT_EQ(output.CountUntouched(), 5u * 30u + 7u);
}

TEST(Subdivider, AxesInAnyOrderOfMemory)
{
  const Box       box{ { 3, 40 }, { -4, 9 }, { 0, 12 } };
  const Options   options = MakeOptions({ true, true, true });
  const TestArray input = MakeInput(ElementType::Int16, box, 2);
  const TestArray whole = MakeWhole(input, ElementType::Int16, options);
  TestLayout      reversed = TestLayout::Dense(3);
  std::reverse(reversed.Order.begin(), reversed.Order.end());
  TestArray output(ElementType::Int16, whole.GetBox(), reversed);
  Workspace workspace;
  Subdivide(Cut(input, box, reversed), box, output, options, 2, workspace);
  // The sums are taken in another order: a tie may be rounded the other way.
  TestArray::ForEachIndex(box, [&](const TestArray::Index & index) {
    const TestArray::Index child{ 2 * index[0], 2 * index[1] + 1, 2 * index[2] };
    EXPECT_LE(std::abs(output.Get(child) - whole.Get(child)), 1.0);
  });
}

/** Of one element, an axis may have the stride of another one; its place in memory must not depend on the part. */
TEST(Subdivider, AxesOfOneElementHaveTheSamePlaceInAllParts)
{
  const Flags allSubdivided{ true, true, true };
  const Flags twoSubdivided{ true, false, true };
  for (const Scheme & scheme : Schemes)
  {
    for (const Flags & subdivided : { twoSubdivided, allSubdivided })
    {
      for (const bool isReversed : { false, true })
      {
        const Box     box{ { -8, 32 }, { 4, subdivided[1] ? 1u : 3u }, { 5, 1 } };
        const Options options = MakeOptions(subdivided, scheme);
        TestLayout    layout = TestLayout::Dense(3);
        if (isReversed)
        {
          std::reverse(layout.Order.begin(), layout.Order.end());
        }
        const TestArray input = Cut(MakeInput(ElementType::UInt8, box, 3), box, layout);
        const TestArray whole = MakeWhole(input, ElementType::Float, options);
        Box             partBox = whole.GetBox();
        partBox[1] = { partBox[1].First + 1, 1 };
        // One element more between the rows along one axis of one element and those along the other.
        for (const std::ptrdiff_t free : { 0, 1 })
        {
          layout.Free = { 0, free, 2 * free };
          const Box request = Subdivider::GetInputRequest(partBox, box, options);
          TestArray part(ElementType::Float, partBox, layout);
          Workspace workspace;
          Subdivide(Cut(input, request, layout), box, part, options, 1, workspace);
          EXPECT_EQ(CountDifferences(part, whole), 0u) << scheme.Name << ' ' << isReversed << ' ' << free;
        }
      }
    }
  }
}

/** Whether rows along axis 0 of two-dimensional arrays of bytes are those of the whole. */
bool
HasRowsOf(const TestArray & part, const TestArray & whole)
{
  const Box  box = part.GetBox();
  const auto last = box[1].First + static_cast<std::int64_t>(box[1].Size);
  bool       isSame = true;
  for (std::int64_t y = box[1].First; y < last; ++y)
  {
    isSame =
      isSame && part.GetBytes({ box[0].First, y }, box[0].Size) == whole.GetBytes({ box[0].First, y }, box[0].Size);
  }
  return isSame;
}

/** Outputs of more than 16 MiB are written past the cache. */
TEST(Subdivider, LargeOutputsAreTheBytesOfSmallOnes)
{
  for (const Flags & subdivided : { Flags{ true, true }, Flags{ false, true }, Flags{ true, false } })
  {
    const std::uint64_t width = subdivided[0] ? 2121 : 4242;
    const std::uint64_t height = subdivided[1] ? 2083 : 4166;
    const Box           box{ { -5, width }, { 7, height } };
    const Options       options = MakeOptions(subdivided);
    TestArray           input(ElementType::UInt8, box);
    std::mt19937        random(3);
    auto * const        elements = static_cast<std::uint8_t *>(input.View().Data);
    std::generate_n(elements, width * height, [&random] { return static_cast<std::uint8_t>(random()); });

    const TestArray whole = MakeWhole(input, ElementType::UInt8, options);
    ASSERT_GT(CountElements(whole.GetBox()), std::size_t{ 16 } << 20);
    Box small = whole.GetBox();
    small[0] = { small[0].First + 3, small[0].Size - 5 };
    small[1] = { small[1].First + 11, 99 };
    TestArray part(ElementType::UInt8, small);
    Workspace workspace;
    Subdivide(input, box, part, options, 2, workspace);
    EXPECT_TRUE(HasRowsOf(part, whole));

    // Rows that begin anywhere in a cache line, some with half a voxel, written by several threads.
    Box        large = whole.GetBox();
    TestLayout layout = TestLayout::Dense(2);
    layout.Free[0] = 3;
    large[0] = { large[0].First + 1, large[0].Size - 2 };
    TestArray most(ElementType::UInt8, large, layout);
    Subdivide(input, box, most, options, 3, workspace);
    EXPECT_TRUE(HasRowsOf(most, whole));
  }
}

TEST(Subdivider, CopiesExactlyWhereNothingIsSubdivided)
{
  for (const ElementType type : { ElementType::Int64, ElementType::UInt64 })
  {
    const Box  box{ { 0, 5 }, { -2, 7 } };
    TestArray  input(type, box);
    auto *     elements = static_cast<std::uint64_t *>(input.View().Data);
    TestLayout layout = TestLayout::Dense(2);
    layout.IsReversed = { true, false };
    for (std::uint64_t i = 0; i < 35; ++i)
    {
      elements[i] = ((std::uint64_t{ 1 } << 62) | (std::uint64_t{ 1 } << 53)) + 2 * i + 1;
    }
    TestArray output(type, box, layout);
    Workspace workspace;
    EXPECT_EQ(Subdivide(input, box, output, MakeOptions({ false, false }), 2, workspace), 35u);
    EXPECT_EQ(CountDifferences(output, input), 0u);
  }
}

TEST(Subdivider, ConvertsWhereNothingIsSubdivided)
{
  const Box    box{ { 0, 4 } };
  TestArray    input(ElementType::Double, box);
  const double values[] = { -7.0, 2.5, 254.6, 1e300 };
  const double expected[] = { 0.0, 2.0, 255.0, 255.0 };
  for (std::int64_t i = 0; i < 4; ++i)
  {
    input.Set({ i }, values[i]);
  }
  TestArray output(ElementType::UInt8, box);
  Workspace workspace;
  Subdivide(input, box, output, MakeOptions({ false }), 1, workspace);
  for (std::int64_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(output.Get({ i }), expected[i]);
  }
}

TEST(Subdivider, FirstIndicesFarFromZero)
{
  constexpr std::int64_t quarter = std::int64_t{ 1 } << 62;
  const TestArray        near0 = MakeInput(ElementType::Float, { { 0, 20 }, { 0, 9 } }, 5);
  const Options          options = MakeOptions({ true, true });
  const TestArray        expected = MakeWhole(near0, ElementType::Float, options);
  for (const std::int64_t first : { -quarter, quarter - 20, (std::int64_t{ 1 } << 53) + 1 })
  {
    const TestArray far = MakeInput(ElementType::Float, { { first, 20 }, { first, 9 } }, 5);
    TestArray       shifted(ElementType::Float, far.GetBox());
    TestArray::ForEachIndex(near0.GetBox(), [&](const TestArray::Index & index) {
      shifted.Set({ index[0] + first, index[1] + first }, near0.Get(index));
    });
    const TestArray output = MakeWhole(shifted, ElementType::Float, options);
    TestArray::ForEachIndex(expected.GetBox(), [&](const TestArray::Index & index) {
      EXPECT_EQ(output.Get({ index[0] + 2 * first, index[1] + 2 * first }), expected.Get(index));
    });
  }
  EXPECT_THROW(Subdivider::GetWholeOutput({ { quarter - 19, 20 } }, { true }), std::overflow_error);
  EXPECT_THROW(Subdivider::GetWholeOutput({ { -quarter - 1, 20 } }, { true }), std::overflow_error);
  EXPECT_THROW(Subdivider::GetWholeOutput({ { 2 * (quarter - 1), 3 } }, { false }), std::overflow_error);
}

TEST(Subdivider, OneWorkspaceForRunsOfAllKinds)
{
  Workspace workspace;
  for (int round = 0; round < 2; ++round)
  {
    for (const BoxCase & boxCase : BoxCases)
    {
      for (const double tension : { 1.5, 4.0 })
      {
        for (const ElementType type : { ElementType::Float, ElementType::Double })
        {
          Options options = MakeOptions(boxCase.Subdivided);
          options.Tension = tension;
          const TestArray input = MakeInput(ElementType::UInt8, boxCase.Whole, 7);
          const TestArray expected = MakeWhole(input, type, options);
          TestArray       output(type, expected.GetBox());
          Subdivide(input, boxCase.Whole, output, options, 2, workspace);
          EXPECT_EQ(CountDifferences(output, expected), 0u) << boxCase.Name;
        }
      }
    }
  }
}

TEST(Subdivider, StopsBeforeTheNextTile)
{
  const TestArray input = MakeInput(ElementType::UInt8, { { 0, 60 }, { 0, 60 }, { 0, 60 } }, 1);
  const Options   options = MakeOptions({ true, true, true });
  TestArray       output(ElementType::UInt8, Subdivider::GetWholeOutput(input.GetBox(), options.SubdividedAxes));
  Workspace       workspace;
  Subdivider      subdivider(input.View(), input.GetBox(), output.View(), options, 4, workspace);
  ASSERT_GT(subdivider.GetNumberOfTiles(), 2u);

  CountingMonitor stopped;
  stopped.StopAt = 0;
  RunTiles(subdivider, 2, stopped);
  EXPECT_EQ(stopped.GetElements(), 0u);

  CountingMonitor afterOneTile;
  afterOneTile.StopAt = 1;
  RunTiles(subdivider, 1, afterOneTile);
  EXPECT_GT(afterOneTile.GetElements(), 0u);
  EXPECT_LT(afterOneTile.GetElements(), CountElements(output.GetBox()) / 2);
}

struct Unavailable : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** Throws for the asked-for element number \c number and those after it. */
class ThrowingElements final : public OutsideElements
{
public:
  explicit ThrowingElements(const int number)
    : m_Left(number)
  {}

  double
  GetElement(const std::int64_t *) const override
  {
    if (m_Left-- <= 0)
    {
      throw Unavailable("no such element");
    }
    return 1.0;
  }

private:
  mutable std::atomic<int> m_Left;
};

TEST(Subdivider, PassesOnWhatABoundaryThrows)
{
  const TestArray input = MakeInput(ElementType::UInt8, { { 0, 30 }, { 0, 30 }, { 0, 30 } }, 1);
  Options         options = MakeOptions({ true, true, true });
  const TestArray expected = MakeWhole(input, ElementType::UInt8, options);
  TestArray       output(ElementType::UInt8, expected.GetBox());
  Workspace       workspace;
  for (const int number : { 0, 1, 1000, 20000 })
  {
    options.Boundary = Boundary::Custom(std::make_shared<ThrowingElements>(number));
    EXPECT_THROW(Subdivide(input, input.GetBox(), output, options, 3, workspace), Unavailable);
    // The kernels of the run that failed do for the next one.
    options.Boundary = Boundary::Nearest();
    Subdivide(input, input.GetBox(), output, options, 3, workspace);
    EXPECT_EQ(CountDifferences(output, expected), 0u);
  }
}

class OutsideSeven final : public OutsideElements
{
public:
  double
  GetElement(const std::int64_t *) const override
  {
    return 7.0;
  }
};

/** Whom a custom boundary asks may need all of the array; the run itself needs what it reads. */
TEST(Subdivider, CustomBoundaryWithAPartOfTheInput)
{
  const TestArray whole = MakeInput(ElementType::Float, { { 0, 30 }, { 0, 30 } }, 1);
  const Box       box{ { 0, 10 }, { 0, 10 } };
  Options         options = MakeOptions({ true, true });
  options.Boundary = Boundary::Constant({ 7.0 });
  const TestArray part = Cut(whole, Subdivider::GetInputRequest(box, whole.GetBox(), options), TestLayout::Dense(2));
  const TestArray expected = MakeWhole(whole, ElementType::Float, options);

  options.Boundary = Boundary::Custom(std::make_shared<OutsideSeven>());
  EXPECT_EQ(Subdivider::GetInputRequest(box, whole.GetBox(), options), whole.GetBox());
  TestArray output(ElementType::Float, box);
  Workspace workspace;
  Subdivide(part, whole.GetBox(), output, options, 1, workspace);
  EXPECT_EQ(CountDifferences(output, expected), 0u);
}

/** Each component of the pixels has the outside of its own. */
TEST(Subdivider, AConstantForEachComponent)
{
  const std::vector<double> constants{ 5.0, -7.0, 11.0 };
  const TestArray           whole = MakeInput(ElementType::Float, { { 0, 3 }, { 0, 9 }, { 0, 8 } }, 1);
  Options                   options = MakeOptions({ false, true, true });
  options.Boundary = Boundary::Constant(constants);
  const TestArray all = MakeWhole(whole, ElementType::Float, options);
  for (std::int64_t component = 0; component < 3; ++component)
  {
    SCOPED_TRACE(component);
    const TestArray one = Cut(whole, { { component, 1 }, { 0, 9 }, { 0, 8 } }, TestLayout::Dense(3));
    options.Boundary = Boundary::Constant({ constants[static_cast<std::size_t>(component)] });
    const TestArray expected = MakeWhole(one, ElementType::Float, options);
    EXPECT_EQ(CountDifferences(Cut(all, expected.GetBox(), TestLayout::Dense(3)), expected), 0u);
  }
}

/** The message of what making a Subdivider throws. */
template <typename TException = std::invalid_argument>
std::string
GetError(const ConstArrayView & input, const Box & whole, const ArrayView & output, const Options & options)
{
  try
  {
    Workspace workspace;
    Subdivider(input, whole, output, options, 1, workspace);
  }
  catch (const TException & error)
  {
    return error.what();
  }
  return "nothing is wrong";
}

class SubdividerErrors : public testing::Test
{
protected:
  std::string
  GetError()
  {
    return ::GetError(Input, Whole, Output, Settings);
  }

  const Box      Whole{ { 0, 8 }, { 0, 8 } };
  TestArray      InputArray{ ElementType::UInt8, Whole };
  TestArray      OutputArray{ ElementType::UInt8, { { 0, 16 }, { 0, 16 } } };
  ConstArrayView Input = static_cast<const TestArray &>(InputArray).View();
  ArrayView      Output = OutputArray.View();
  Options        Settings = MakeOptions({ true, true });
};

TEST_F(SubdividerErrors, NoneAtFirst) { EXPECT_EQ(GetError(), "nothing is wrong"); }

TEST_F(SubdividerErrors, Tension)
{
  Settings.Tension = 1.0;
  EXPECT_NE(GetError(), "nothing is wrong");
}

TEST_F(SubdividerErrors, Sizes)
{
  Output.Axes[1].Size = 0;
  EXPECT_EQ(GetError(), "the output has size 0 along axis 1, but must have at least 1");
  Output.Axes[1].Size = 16;
  Input.Axes[0].Size = 0;
  EXPECT_EQ(GetError(), "the input has size 0 along axis 0, but must have at least 1");
}

TEST_F(SubdividerErrors, WholeInput)
{
  EXPECT_EQ(::GetError(Input, { { 0, 8 }, { 0, 0 } }, Output, Settings),
            "the whole input has size 0 along axis 1, but must have at least 1");
  EXPECT_EQ(::GetError(Input, { { 0, 8 }, { 0, 7 } }, Output, Settings),
            "the whole output has 14 elements from index 0 along axis 1, but the output has 16 elements from index 0");
}

TEST_F(SubdividerErrors, NumberOfAxes)
{
  Settings.SubdividedAxes = { true };
  EXPECT_EQ(GetError(), "SubdividedAxes has 1 axes, but the whole input has 2");
  Settings.SubdividedAxes = { true, true };
  Input.Axes.pop_back();
  EXPECT_EQ(GetError(), "the input has 1 axes, but the whole input has 2");
}

TEST_F(SubdividerErrors, FourSubdividedAxes)
{
  const Box       whole(4, { 0, 2 });
  const TestArray input(ElementType::UInt8, whole);
  TestArray       output(ElementType::UInt8, Box(4, { 0, 4 }));
  EXPECT_EQ(::GetError(input.View(), whole, output.View(), MakeOptions({ true, true, true, true })),
            "4 axes are to be subdivided, but at most three can be");
}

TEST_F(SubdividerErrors, InputLacksWhatIsRead)
{
  Input.Axes[0].Size = 7;
  EXPECT_EQ(GetError(),
            "the input has 7 elements from index 0 along axis 0, but what is read of it has 8 elements from index 0");
}

TEST_F(SubdividerErrors, InputBeyondTheWhole)
{
  Input.Axes[0].First = -1;
  EXPECT_EQ(GetError(),
            "the whole input has 8 elements from index 0 along axis 0, but the input has 8 elements from index -1");
}

TEST_F(SubdividerErrors, Constants)
{
  Settings.Boundary = Boundary::Constant({ 1.0, 2.0 });
  EXPECT_EQ(GetError(), "the boundary has 2 constants, but must have a single one where axis 0 is subdivided");
  Settings.SubdividedAxes = { false, true };
  Output.Axes[0].Size = 8;
  EXPECT_EQ(GetError(), "the boundary has 2 constants, but must have one, or as many as axis 0, 8");
}

TEST_F(SubdividerErrors, Memory)
{
  Output.Axes[0].Stride = 0;
  EXPECT_EQ(GetError(), "the output has stride 0 along axis 0, but its elements must lie apart");
  Output.Data = nullptr;
  EXPECT_EQ(GetError(), "the output has no data");
}

TEST_F(SubdividerErrors, DistancesThatDoNotFit)
{
  for (const std::ptrdiff_t stride :
       { std::numeric_limits<std::ptrdiff_t>::max() / 4, std::numeric_limits<std::ptrdiff_t>::min() })
  {
    Input.Axes[1].Stride = stride;
    EXPECT_NE(::GetError<std::overflow_error>(Input, Whole, Output, Settings), "nothing is wrong");
  }
}

} // namespace
