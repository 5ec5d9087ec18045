// SPDX-License-Identifier: Apache-2.0

// Ties that the label of the parent decides. Neighbours were chosen so that their weights, which are products of those
// of two masks, have equal sums; where a vote is rounded, these are no ties.

#include "NonOscillatorySubdivision/LabelSubdivider.h"
#include "SubdividerTestHelpers.h"

#include <gtest/gtest.h>

#include <array>
#include <utility>

namespace
{

using namespace itk::Subdivision;

/** The six by six voxels that the upper child of a voxel reads, itself at row and column 2. */
using Stencil = std::array<const char *, 6>;

/** The label of the upper child of a voxel in a map whose labels are those that a function gives to the places of the
 * voxel's stencil, and elsewhere that of the corner. */
template <typename TLabel>
double
ElectUpperChild(const char * const scheme, const TLabel & labelAt)
{
  const TestArray::Box box{ { 0, 14 }, { 0, 14 } };
  TestArray            labels(ElementType::UInt8, box);
  TestArray::ForEachIndex(box, [&](const TestArray::Index & index) {
    const auto x = index[0] - 4;
    const auto y = index[1] - 4;
    const bool isRead = x >= 0 && x < 6 && y >= 0 && y < 6;
    labels.Set(index, isRead ? labelAt(static_cast<std::size_t>(x), static_cast<std::size_t>(y)) : labelAt(5, 0));
  });
  Options options;
  options.Scheme = &FindScheme(scheme);
  options.SubdividedAxes = { true, true };
  TestArray       output(ElementType::UInt8, { { 0, 28 }, { 0, 28 } });
  CountingMonitor monitor;
  LabelSubdivider run(std::as_const(labels).View(), box, output.View(), options);
  RunTiles(run, 1, monitor);
  return output.Get({ 2 * 6 + 1, 2 * 6 + 1 });
}

/** Linear: the places of one label weigh exactly a half, those of the other, the parent's, the other half. */
TEST(LabelSubdividerTies, OfTwoLabelsTheParentsWins)
{
  const Stencil half{ "000000", "100000", "000100", "001100", "011000", "110000" };
  for (const double other : { 3.0, 5.0 })
  {
    EXPECT_EQ(ElectUpperChild("linear", [&](auto x, auto y) { return half[y][x] == '1' ? other : 4.0; }), 4.0);
  }
}

/** B-spline: the places of one label weigh exactly what the parent does; each other voxel has a label of its own. */
TEST(LabelSubdividerTies, OfManyLabelsTheParentsWins)
{
  const Stencil asMuch{ "111100", "110011", "100011", "110010", "111111", "011110" };
  for (const double parent : { 1.0, 200.0 })
  {
    const auto labelAt = [&](const std::size_t x, const std::size_t y) {
      const bool isParent = x == 2 && y == 2;
      return isParent ? parent : asMuch[y][x] == '1' ? 7.0 : static_cast<double>(10 + 6 * y + x);
    };
    EXPECT_EQ(ElectUpperChild("bspline", labelAt), parent);
  }
}

} // namespace
