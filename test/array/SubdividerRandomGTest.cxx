// SPDX-License-Identifier: Apache-2.0
#include "common/GeneratedCases.h"
#include "RandomRun.h"

#include <cmath>

namespace
{

using namespace itk::Subdivision;

double
Saturate(const double value, const ElementType type)
{
  return WithElementType(type, [value](const auto tag) {
    using Limits = std::numeric_limits<typename decltype(tag)::Type>;
    return std::clamp(value, static_cast<double>(Limits::lowest()), static_cast<double>(Limits::max()));
  });
}

/** Compares a random box of the output, made from no more than what is requested, with the reference. */
void
ExpectReference(const unsigned int seed)
{
  RandomRun run(seed, SubdividerOracle::Dimension, 120);
  SCOPED_TRACE(run.Describe());
  const TestArray all = run.MakeInput(run.MakeType());
  const Box       box = run.MakeBox(run.GetWholeOutput());
  const TestArray input = Cut(all, Subdivider::GetInputRequest(box, run.Whole, run.What), run.MakeLayout());
  TestArray       output(run.MakeType(), box, run.MakeLayout());
  Workspace       workspace;
  const auto      written = Subdivide(input, run.Whole, output, run.What, 1 + run.Below(3), workspace);
  EXPECT_EQ(written, CountElements(box));

  const SubdividerOracle oracle = run.MakeOracle(all);
  const bool             isDouble = NeedsDouble(input.GetType()) || NeedsDouble(output.GetType());
  // Values are a few hundreds at most: some units in the last place, and half an integer where they are rounded.
  const double tolerance =
    (isDouble && output.GetType() != ElementType::Float ? 1e-11 : 2e-4) + (IsInteger(output.GetType()) ? 0.5 : 0.0);
  TestArray::ForEachIndex(box, [&](const TestArray::Index & index) {
    EXPECT_NEAR(output.Get(index), Saturate(oracle.At(index), output.GetType()), tolerance)
      << GetName(input.GetType()) << " to " << GetName(output.GetType());
  });
}

TEST(SubdividerRandom, AgreesWithTheReference) { ForEachGeneratedCase(300, ExpectReference); }

} // namespace
