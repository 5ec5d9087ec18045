// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/Tiling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <stdexcept>

namespace
{

using namespace itk::Subdivision;

/** Cells of all tiles, in the order of an array; the number of tiles that have each of them. */
std::vector<int>
CountCovers(const Tiling & tiling, const Sizes & sizes)
{
  std::size_t cells = 1;
  for (const std::uint64_t size : sizes)
  {
    cells *= size;
  }
  std::vector<int> covers(cells);
  for (std::size_t number = 0; number < tiling.GetNumberOfTiles(); ++number)
  {
    const Box   tile = tiling.GetTile(number);
    std::size_t inTile = 1;
    for (std::size_t axis = 0; axis < tile.size(); ++axis)
    {
      EXPECT_GE(tile[axis].Size, 1u);
      EXPECT_LE(tile[axis].Size, tiling.GetTileSize()[axis]);
      EXPECT_LE(static_cast<std::uint64_t>(tile[axis].First) + tile[axis].Size, sizes[axis]);
      inTile *= tile[axis].Size;
    }
    for (std::size_t i = 0; i < inTile; ++i)
    {
      std::size_t rest = i;
      std::size_t position = 0;
      std::size_t stride = 1;
      for (std::size_t axis = 0; axis < tile.size(); ++axis)
      {
        position += (static_cast<std::size_t>(tile[axis].First) + rest % tile[axis].Size) * stride;
        rest /= tile[axis].Size;
        stride *= sizes[axis];
      }
      ++covers.at(position);
    }
  }
  return covers;
}

TEST(Tiling, TilesAreDisjointAndCoverAll)
{
  std::mt19937 random(1);
  for (int run = 0; run < 300; ++run)
  {
    const std::size_t axes = 1 + random() % 5;
    Sizes             sizes(axes, 1);
    Flags             subdivided(axes);
    // One axis may be long enough to be cut, the others keep the number of cells small.
    for (std::uint64_t & size : sizes)
    {
      size = 1 + random() % 12;
    }
    sizes[random() % axes] = 1 + random() % (axes < 3 ? 5000 : 300);
    for (std::size_t axis = 0; axis < axes; ++axis)
    {
      subdivided[axis] = random() % 2 == 0 && std::count(subdivided.begin(), subdivided.end(), true) < 3;
    }
    const Tiling           tiling(sizes, subdivided, 3 + 2 * static_cast<int>(random() % 2), 1 + random() % 9);
    const std::vector<int> covers = CountCovers(tiling, sizes);
    EXPECT_EQ(std::count(covers.begin(), covers.end(), 1), static_cast<std::ptrdiff_t>(covers.size())) << "run " << run;
  }
}

TEST(Tiling, TilesFitTheCaches)
{
  std::mt19937 random(2);
  for (int run = 0; run < 100; ++run)
  {
    const Sizes sizes{ 1 + random() % 5000, 1 + random() % 5000, 1 + random() % 5000 };
    const Sizes xyz = Tiling(sizes, { true, true, true }, 5, 1 + random() % 64).GetTileSize();
    EXPECT_LE(xyz[0], 256u);
    EXPECT_LE(xyz[1], 48u);
    const Sizes yz = Tiling(sizes, { false, true, true }, 5, 1 + random() % 64).GetTileSize();
    EXPECT_LE(yz[0], 1024u);
    const Sizes xy = Tiling(sizes, { true, true, false }, 5, 1 + random() % 64).GetTileSize();
    EXPECT_LE(xy[0], 1024u);
    EXPECT_LE(xy[2], std::max<std::uint64_t>(65536 / (xy[0] * 1), 1));
  }
}

TEST(Tiling, ThreadsAreBalanced)
{
  for (unsigned int threads = 1; threads <= 16; ++threads)
  {
    // No more than a quarter of the threads' time is lost to a last round that is not full.
    const std::size_t tiles = Tiling({ 250, 250, 250 }, { true, true, true }, 5, threads).GetNumberOfTiles();
    const std::size_t rounds = (tiles + threads - 1) / threads;
    EXPECT_LE(static_cast<double>(rounds * threads - tiles), 0.25 * static_cast<double>(rounds * threads)) << threads;
  }
}

TEST(Tiling, FourthSubdividedAxisIsRefused)
{
  EXPECT_THROW(Tiling({ 9, 9, 9, 9 }, { true, true, true, true }, 5, 1), std::invalid_argument);
}

TEST(Tiling, WhatMakesNoSenseIsRefused)
{
  EXPECT_THROW(Tiling({}, {}, 5, 1), std::invalid_argument);
  EXPECT_THROW(Tiling({ 9, 0 }, { true, true }, 5, 1), std::invalid_argument);
  EXPECT_THROW(Tiling({ 9, 9 }, { true }, 5, 1), std::invalid_argument);
  EXPECT_THROW(Tiling({ 9 }, { true }, -1, 1), std::invalid_argument);
}

TEST(Tiling, HugeSizes)
{
  constexpr std::uint64_t huge = std::uint64_t{ 1 } << 36;
  // As many tiles as 32 bits count, and more.
  for (const std::uint64_t size : { std::uint64_t{ 3 }, huge })
  {
    const Sizes sizes{ huge, size };
    if (size == huge && std::numeric_limits<std::size_t>::digits == 32)
    {
      EXPECT_THROW(Tiling(sizes, { true, false }, 5, 8), std::overflow_error);
      continue;
    }
    const Tiling tiling(sizes, { true, false }, 5, 8);
    const Box    last = tiling.GetTile(tiling.GetNumberOfTiles() - 1);
    for (std::size_t axis = 0; axis < last.size(); ++axis)
    {
      EXPECT_EQ(static_cast<std::uint64_t>(last[axis].First) + last[axis].Size, sizes[axis]);
    }
  }
  EXPECT_THROW(Tiling({ huge << 26, huge << 26, huge << 26 }, { false, false, false }, 5, 8), std::overflow_error);
}

} // namespace
