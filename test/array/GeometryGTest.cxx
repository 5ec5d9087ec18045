// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/Geometry.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

namespace
{

using namespace itk::Subdivision;

constexpr std::int64_t Lowest = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t Largest = std::numeric_limits<std::int64_t>::max();

/** floor(m / 2), by search. */
std::int64_t
FindParent(const std::int64_t child)
{
  std::int64_t parent = -100;
  while (2 * (parent + 1) <= child)
  {
    ++parent;
  }
  return parent;
}

TEST(Geometry, ChildrenAndParentsOfSmallIntervals)
{
  for (std::int64_t first = -9; first <= 9; ++first)
  {
    for (std::uint64_t size = 1; size <= 9; ++size)
    {
      const Interval interval{ first, size };
      const Interval children = GetChildren(interval);
      EXPECT_EQ(children.First, 2 * first);
      EXPECT_EQ(children.Size, 2 * size);
      EXPECT_EQ(GetParents(children), interval);

      const std::int64_t last = first + static_cast<std::int64_t>(size) - 1;
      const Interval     parents = GetParents(interval);
      EXPECT_EQ(parents.First, FindParent(first));
      EXPECT_EQ(parents.First + static_cast<std::int64_t>(parents.Size) - 1, FindParent(last));
    }
  }
}

TEST(Geometry, StencilIsWhatSomeChildReads)
{
  constexpr int radius = 5;
  for (std::int64_t first = -9; first <= 9; ++first)
  {
    for (std::int64_t last = first; last <= first + 8; ++last)
    {
      // A lower child reads from radius before its parent to one less after it; an upper child the other way round.
      std::int64_t lowest = Largest;
      std::int64_t highest = Lowest;
      for (std::int64_t child = first; child <= last; ++child)
      {
        const std::int64_t parent = FindParent(child);
        const bool         isUpper = child != 2 * parent;
        lowest = std::min(lowest, parent - radius + (isUpper ? 1 : 0));
        highest = std::max(highest, parent + radius - (isUpper ? 0 : 1));
      }
      const Interval stencil = GetStencil({ first, static_cast<std::uint64_t>(last - first + 1) }, radius);
      EXPECT_EQ(stencil.First, lowest);
      EXPECT_EQ(stencil.First + static_cast<std::int64_t>(stencil.Size) - 1, highest);
    }
  }
}

TEST(Geometry, FarFromZero)
{
  constexpr std::int64_t quarter = std::int64_t{ 1 } << 62;
  EXPECT_EQ(GetChildren({ -quarter, 1 }), (Interval{ Lowest, 2 }));
  EXPECT_EQ(GetChildren({ quarter - 1, 1 }), (Interval{ Largest - 1, 2 }));
  EXPECT_EQ(GetParents({ Lowest, 1 }), (Interval{ -quarter, 1 }));
  EXPECT_EQ(GetParents({ Lowest + 1, 2 }), (Interval{ -quarter, 2 }));
  EXPECT_EQ(GetParents({ Largest, 1 }), (Interval{ quarter - 1, 1 }));
  EXPECT_EQ(GetStencil({ Largest, 1 }, 3), (Interval{ quarter - 3, 6 }));
  constexpr std::int64_t beyondDouble = (std::int64_t{ 1 } << 53) + 1;
  EXPECT_EQ(GetParents({ 2 * beyondDouble + 1, 2 }), (Interval{ beyondDouble, 2 }));
}

TEST(Geometry, WhatDoesNotFitThrows)
{
  constexpr std::int64_t  quarter = std::int64_t{ 1 } << 62;
  constexpr std::uint64_t half = std::uint64_t{ 1 } << 63;
  EXPECT_THROW(GetChildren({ -quarter - 1, 1 }), std::overflow_error);
  EXPECT_THROW(GetChildren({ quarter, 1 }), std::overflow_error);
  EXPECT_THROW(GetChildren({ quarter - 1, 2 }), std::overflow_error);
  EXPECT_THROW(GetChildren({ 0, half + 1 }), std::overflow_error);
  EXPECT_THROW(GetChildren({ -quarter, half - 1 }), std::overflow_error);
  EXPECT_THROW(GetParents({ Largest, 2 }), std::overflow_error);
  EXPECT_THROW(GetParents({ Lowest, std::numeric_limits<std::uint64_t>::max() }), std::overflow_error);
  EXPECT_THROW(GetStencil({ Largest, 2 }, 5), std::overflow_error);
}

TEST(Geometry, NothingHasNoParents)
{
  EXPECT_THROW(GetParents({ 0, 0 }), std::invalid_argument);
  EXPECT_THROW(GetStencil({ 0, 0 }, 3), std::invalid_argument);
  EXPECT_THROW(GetChildren({ 0, 0 }), std::invalid_argument);
}

} // namespace
