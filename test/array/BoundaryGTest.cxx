// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/Boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace
{

using namespace itk::Subdivision;

struct Zero final : OutsideElements
{
  double
  GetElement(const std::int64_t *) const override
  {
    return 0.0;
  }
};

/** The index after a walk from 0, a step at a time: at an end, stays there, turns around or begins anew. */
std::int64_t
Walk(const char rule, const std::int64_t index, const std::int64_t size)
{
  std::int64_t place = 0;
  std::int64_t direction = index < 0 ? -1 : 1;
  for (std::int64_t step = 0; step < std::abs(index); ++step)
  {
    const std::int64_t next = place + direction;
    if (next >= 0 && next < size)
    {
      place = next;
    }
    else if (rule == 'm')
    {
      direction = -direction;
    }
    else if (rule == 'p')
    {
      place = direction < 0 ? size - 1 : 0;
    }
  }
  return place;
}

TEST(Boundary, MapsIndices)
{
  for (std::int64_t size = 1; size <= 7; ++size)
  {
    for (std::int64_t index = -30; index <= 30; ++index)
    {
      EXPECT_EQ(Boundary::Nearest().MapIndex(index, size), Walk('n', index, size)) << index << " of " << size;
      EXPECT_EQ(Boundary::Mirror().MapIndex(index, size), Walk('m', index, size)) << index << " of " << size;
      EXPECT_EQ(Boundary::Periodic().MapIndex(index, size), Walk('p', index, size)) << index << " of " << size;
    }
  }
}

TEST(Boundary, MapsIndicesOfHugeArrays)
{
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(Boundary::Mirror().MapIndex(-1, most), 0);
  EXPECT_EQ(Boundary::Mirror().MapIndex(-4, most), 3);
  EXPECT_EQ(Boundary::Mirror().MapIndex(most, most), most - 1);
  EXPECT_EQ(Boundary::Periodic().MapIndex(-1, most), most - 1);
  EXPECT_EQ(Boundary::Nearest().MapIndex(-1, most), 0);
}

/** The request is the smallest interval with all elements that a walk ends at. */
TEST(Boundary, RequestsExactlyWhatIsRead)
{
  const std::pair<char, Boundary> boundaries[] = { { 'n', Boundary::Nearest() },
                                                   { 'm', Boundary::Mirror() },
                                                   { 'p', Boundary::Periodic() } };
  for (const auto & [rule, boundary] : boundaries)
  {
    for (std::int64_t size = 1; size <= 6; ++size)
    {
      for (std::int64_t first = -15; first <= 15; ++first)
      {
        for (std::int64_t last = first; last <= 20; ++last)
        {
          std::int64_t lowest = size;
          std::int64_t highest = -1;
          for (std::int64_t index = first; index <= last; ++index)
          {
            lowest = std::min(lowest, Walk(rule, index, size));
            highest = std::max(highest, Walk(rule, index, size));
          }
          constexpr std::int64_t start = -4;
          const Interval request = boundary.GetRequest({ start + first, static_cast<std::uint64_t>(last - first + 1) },
                                                       { start, static_cast<std::uint64_t>(size) });
          const Interval expected{ start + lowest, static_cast<std::uint64_t>(highest - lowest + 1) };
          EXPECT_EQ(request, expected) << rule << " " << first << " to " << last << " of " << size;
        }
      }
    }
  }
}

TEST(Boundary, ConstantRequestsWhatIsInside)
{
  const Boundary boundary = Boundary::Constant({ 7.0 });
  EXPECT_FALSE(boundary.MapsIndices());
  EXPECT_EQ(boundary.GetRequest({ -3, 5 }, { 0, 9 }), (Interval{ 0, 2 }));
  EXPECT_EQ(boundary.GetRequest({ 7, 5 }, { 0, 9 }), (Interval{ 7, 2 }));
  EXPECT_EQ(boundary.GetRequest({ 20, 5 }, { 0, 9 }).Size, 1u);
}

TEST(Boundary, CustomRequestsAllWhereAnythingLiesOutside)
{
  const Boundary boundary = Boundary::Custom(std::make_shared<Zero>());
  EXPECT_FALSE(boundary.MapsIndices());
  EXPECT_EQ(boundary.GetRequest({ 2, 5 }, { 0, 9 }), (Interval{ 2, 5 }));
  EXPECT_EQ(boundary.GetRequest({ -1, 2 }, { 0, 9 }), (Interval{ 0, 9 }));
  EXPECT_EQ(boundary.GetRequest({ 8, 2 }, { 0, 9 }), (Interval{ 0, 9 }));
}

TEST(Boundary, RefusesNothing)
{
  EXPECT_THROW(Boundary::Constant({}), std::invalid_argument);
  EXPECT_THROW(Boundary::Custom(nullptr), std::invalid_argument);
}

TEST(Boundary, RefusesEmptyArrays)
{
  for (const Boundary & boundary : { Boundary::Nearest(), Boundary::Mirror(), Boundary::Periodic() })
  {
    EXPECT_THROW(boundary.MapIndex(3, 0), std::invalid_argument);
    EXPECT_THROW(boundary.GetRequest({ 3, 4 }, { 0, 0 }), std::invalid_argument);
    EXPECT_THROW(boundary.GetRequest({ 3, 0 }, { 0, 4 }), std::invalid_argument);
  }
}

} // namespace
