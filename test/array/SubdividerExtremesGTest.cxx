// SPDX-License-Identifier: Apache-2.0

// Ends of the ranges of all element types, and callers who have chosen other floating-point arithmetic.

#include "common/GeneratedCases.h"
#include "NonOscillatorySubdivision/LabelSubdivider.h"
#include "RandomRun.h"

#include <cfenv>
#include <cmath>
#include <thread>
#include <utility>

#if defined(__x86_64__)
#  include <xmmintrin.h>
#endif

namespace
{

using namespace itk::Subdivision;
using Index = TestArray::Index;

/** Puts the least and the greatest number of the array's type in its elements, with runs of either. */
void
FillWithEnds(TestArray & array, std::mt19937 & random)
{
  WithElementType(array.GetType(), [&](const auto tag) {
    using Limits = std::numeric_limits<typename decltype(tag)::Type>;
    bool isHigh = false;
    TestArray::ForEachIndex(array.GetBox(), [&](const Index & index) {
      isHigh = random() % 3 == 0 ? !isHigh : isHigh;
      array.SetElement(index, isHigh ? Limits::max() : Limits::lowest());
    });
  });
}

/** Of every integer type in itself: what lies beyond an end is that end, exactly; what lies within is the reference's,
 * rounded, and that to as many digits as double has. */
template <typename T>
void
ExpectSaturated(const TestArray & output, const SubdividerOracle & oracle, std::size_t (&saturated)[2])
{
  using Limits = std::numeric_limits<T>;
  const double lowest = static_cast<double>(Limits::lowest());
  const double highest = static_cast<double>(Limits::max());
  // Float computes integers of up to 16 bits: 16 units in its last place. Double computes the others.
  const double tolerance = 0.5 + 16 * (highest - lowest) *
                                   static_cast<double>(sizeof(T) <= 2 ? std::numeric_limits<float>::epsilon()
                                                                      : std::numeric_limits<double>::epsilon());
  std::size_t wrong = 0;
  TestArray::ForEachIndex(output.GetBox(), [&](const Index & index) {
    const T      element = output.GetElement<T>(index);
    const double expected = oracle.At(index);
    if (expected > highest + tolerance)
    {
      wrong += element != Limits::max() ? 1 : 0;
      ++saturated[1];
    }
    else if (expected < lowest - tolerance)
    {
      wrong += element != Limits::lowest() ? 1 : 0;
      ++saturated[0];
    }
    else
    {
      wrong += std::abs(static_cast<double>(element) - expected) <= tolerance ? 0 : 1;
    }
  });
  EXPECT_EQ(wrong, 0u) << GetName(output.GetType());
}

TEST(SubdividerExtremes, IntegersSaturateAtBothEnds)
{
  std::size_t        saturated[2]{};
  const unsigned int cases = ForEachGeneratedCase(160, [&](const unsigned int seed) {
    RandomRun run(seed, 3, 150);
    run.SetBoundary(static_cast<RandomRun::BoundaryKind>(run.Below(3)));
    TestArray input(static_cast<ElementType>(seed % 8), run.Whole);
    FillWithEnds(input, run.Random);
    SCOPED_TRACE(run.Describe());
    const TestArray        output = run.Subdivide(input);
    const SubdividerOracle oracle = run.MakeOracle(input);
    WithElementType(input.GetType(), [&](const auto tag) {
      using Type = typename decltype(tag)::Type;
      if constexpr (std::is_integral<Type>::value)
      {
        ExpectSaturated<Type>(output, oracle, saturated);
      }
    });
  });
  EXPECT_TRUE(cases < 160 || (saturated[0] > 0 && saturated[1] > 0)) << "nothing was beyond the ends";
}

/** Real values of up to a quarter of the largest have finite children, on any input and under every scheme. */
TEST(SubdividerExtremes, AQuarterOfTheLargestValueStaysFinite)
{
  ForEachGeneratedCase(100, [&](const unsigned int seed) {
    RandomRun run(seed, 3, 600);
    run.SetBoundary(static_cast<RandomRun::BoundaryKind>(run.Below(3)));
    const bool   isFloat = seed % 2 == 0;
    TestArray    input(isFloat ? ElementType::Float : ElementType::Double, run.Whole);
    const double largest =
      isFloat ? static_cast<double>(std::numeric_limits<float>::max()) / 4 : std::numeric_limits<double>::max() / 4;
    TestArray::ForEachIndex(run.Whole,
                            [&](const Index & index) { input.Set(index, run.Below(2) == 0 ? largest : -largest); });
    SCOPED_TRACE(run.Describe());
    const TestArray output = run.Subdivide(input);
    std::size_t     infinite = 0;
    TestArray::ForEachIndex(output.GetBox(),
                            [&](const Index & index) { infinite += std::isfinite(output.Get(index)) ? 0 : 1; });
    EXPECT_EQ(infinite, 0u);
  });
}

/** A way to compute that a caller may have chosen, for the thread that it is made in. */
struct Arithmetic
{
  const char * Name;
  int          Rounding;
  unsigned int Control; // bits of x86's MXCSR

  std::fenv_t
  Begin() const
  {
    std::fenv_t former;
    std::fegetenv(&former);
    std::fesetround(Rounding);
#if defined(__x86_64__)
    _mm_setcsr(_mm_getcsr() | Control);
#endif
    std::feraiseexcept(FE_DIVBYZERO);
    return former;
  }

  /** Whether it still holds, the flag that was raised at the beginning among it, and no other flag. */
  bool
  Holds() const
  {
#if defined(__x86_64__)
    if ((_mm_getcsr() & 0x8040u) != Control)
    {
      return false;
    }
#endif
    return std::fegetround() == Rounding && std::fetestexcept(FE_ALL_EXCEPT) == FE_DIVBYZERO;
  }
};

std::vector<Arithmetic>
GetArithmetics()
{
  std::vector<Arithmetic> arithmetics{
    { "to nearest", FE_TONEAREST, 0 },
#ifdef FE_UPWARD
    { "upward", FE_UPWARD, 0 },
#endif
#ifdef FE_DOWNWARD
    { "downward", FE_DOWNWARD, 0 },
#endif
#ifdef FE_TOWARDZERO
    { "toward zero", FE_TOWARDZERO, 0 },
#endif
  };
#if defined(__x86_64__)
  arithmetics.push_back({ "flush to zero", FE_TONEAREST, 0x8000u });
  arithmetics.push_back({ "denormals are zero", FE_TONEAREST, 0x0040u });
  arithmetics.push_back({ "upward, and both", FE_UPWARD, 0x8040u });
#endif
  return arithmetics;
}

/** Computes in a thread that begins with some arithmetic, and others with it; \c holds tells whether it ends so. */
template <typename TCompute>
TestArray
ComputeIn(const Arithmetic & arithmetic, bool & holds, const TCompute & compute)
{
  TestArray   output = compute.MakeOutput();
  std::thread caller([&] {
    std::feclearexcept(FE_ALL_EXCEPT);
    const std::fenv_t former = arithmetic.Begin();
    compute(output);
    holds = arithmetic.Holds();
    std::fesetenv(&former);
  });
  caller.join();
  return output;
}

struct RunOfValues
{
  const RandomRun & Run;
  const TestArray & Input;
  ElementType       Type;

  TestArray
  MakeOutput() const
  {
    return TestArray(Type, Run.GetWholeOutput());
  }

  void
  operator()(TestArray & output) const
  {
    Workspace workspace;
    Subdivide(Input, Run.Whole, output, Run.What, 2, workspace);
  }
};

struct RunOfLabels
{
  const RandomRun & Run;
  const TestArray & Input;

  TestArray
  MakeOutput() const
  {
    return TestArray(Input.GetType(), Run.GetWholeOutput());
  }

  void
  operator()(TestArray & output) const
  {
    CountingMonitor monitor;
    LabelSubdivider labels(Input.View(), Run.Whole, output.View(), Run.What);
    RunTiles(labels, 2, monitor);
  }
};

template <typename TCompute>
void
ExpectSameInEveryArithmetic(const TCompute & compute)
{
  const auto arithmetics = GetArithmetics();
  const auto bytesOf = [](const TestArray & array) {
    Index first;
    for (const Interval & interval : array.GetBox())
    {
      first.push_back(interval.First);
    }
    return array.GetBytes(first, CountElements(array.GetBox()));
  };
  std::vector<unsigned char> expected;
  for (const Arithmetic & arithmetic : arithmetics)
  {
    bool       holds = false;
    const auto bytes = bytesOf(ComputeIn(arithmetic, holds, compute));
    expected = expected.empty() ? bytes : expected;
    EXPECT_TRUE(bytes == expected) << arithmetic.Name;
    EXPECT_TRUE(holds) << "the caller's choice is another one afterwards: " << arithmetic.Name;
  }
}

/** Whatever the caller has chosen, the bytes are the same in all of its threads, and the choice is kept. */
TEST(SubdividerExtremes, TheCallersArithmeticMakesNoDifference)
{
  ForEachGeneratedCase(60, [](const unsigned int seed) {
    RandomRun  run(seed, 3, 1200);
    const auto inputType = seed % 2 == 0 ? run.MakeRealType() : run.MakeType();
    TestArray  input = run.MakeInput(inputType);
    const bool isReal = !IsInteger(inputType);
    const bool isTiny = isReal && run.Below(2) == 0;
    const auto unit = static_cast<double>(inputType == ElementType::Float ? std::numeric_limits<float>::min()
                                                                          : std::numeric_limits<double>::min());
    TestArray::ForEachIndex(run.Whole, [&](const Index & index) {
      const double noise = static_cast<double>(run.Random()) / 4294967296.0;
      input.Set(index, isReal ? (input.Get(index) + noise) * (isTiny ? unit : 1.0) : input.Get(index));
    });
    SCOPED_TRACE(run.Describe() + ", " + GetName(inputType));
    ExpectSameInEveryArithmetic(RunOfValues{ run, input, seed % 3 == 0 ? run.MakeType() : inputType });
  });
}

TEST(SubdividerExtremes, TheCallersArithmeticMakesNoDifferenceToLabels)
{
  ForEachGeneratedCase(30, [](const unsigned int seed) {
    RandomRun run(seed, 3, 600);
    run.SetScheme(4);
    run.SetBoundary(RandomRun::BoundaryKind::Nearest);
    TestArray input(ElementType::UInt8, run.Whole);
    TestArray::ForEachIndex(run.Whole, [&](const Index & index) { input.Set(index, run.Below(3)); });
    SCOPED_TRACE(run.Describe());
    ExpectSameInEveryArithmetic(RunOfLabels{ run, input });
  });
}

/** Adds up what could not be held. */
class LossMonitor final : public TileMonitor
{
public:
  void
  Completed(std::size_t) override
  {}
  bool
  IsStopped() const override
  {
    return false;
  }
  bool
  CountsLosses() const override
  {
    return true;
  }
  void
  Lost(const std::size_t notANumber, const std::size_t clamped) override
  {
    NotANumber += notANumber;
    Clamped += clamped;
  }

  std::size_t NotANumber{ 0 };
  std::size_t Clamped{ 0 };
};

/** What rounds to a number of the type is no loss: a half below the least one, which is even; not one above the
 * greatest, which is odd. */
TEST(SubdividerExtremes, LossesAreCountedFromTheFirstNumberThatDoesNotFit)
{
  for (const ElementType type : { ElementType::UInt8, ElementType::Int8, ElementType::UInt16, ElementType::Int32 })
  {
    WithElementType(type, [type](const auto tag) {
      using Limits = std::numeric_limits<typename decltype(tag)::Type>;
      const auto   low = static_cast<double>(Limits::lowest());
      const auto   high = static_cast<double>(Limits::max());
      const double values[] = { low - 0.5, low - 0.75, low - 9, high + 0.25, high + 0.5, high + 1, std::nan(""), 0.0 };
      TestArray    input(ElementType::Double, { { 0, 8 } });
      for (std::int64_t i = 0; i < 8; ++i)
      {
        input.Set({ i }, values[i]);
      }
      TestArray output(type, { { 0, 8 } });
      Options   options;
      options.SubdividedAxes = { false };
      Workspace   workspace;
      LossMonitor monitor;
      Subdivider  run(std::as_const(input).View(), input.GetBox(), output.View(), options, 1, workspace);
      RunTiles(run, 1, monitor);
      EXPECT_EQ(monitor.NotANumber, 1u) << GetName(type);
      EXPECT_EQ(monitor.Clamped, 4u) << GetName(type);
    });
  }
}

} // namespace
