// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/Tiling.h"

#include "array/CheckedArithmetic.h"
#include "array/TileAxes.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace itk
{
namespace Subdivision
{
namespace
{

// Found by measurement: rows that are long enough for memory to stream, and enough of them to make up for the halo.
// Smaller tiles would fit a cache nearer to the core, but gain less there than they lose to the halo.
constexpr std::uint64_t WidthOfRows = 1024;
constexpr std::uint64_t WidthOfPlanes = 256;
constexpr std::uint64_t HeightOfPlanes = 48;

/** Tiles without a halo along an axis are cut there until they are no larger than this. */
constexpr std::uint64_t Morsel = std::uint64_t{ 1 } << 16;

constexpr std::uint64_t
DivideUp(const std::uint64_t size, const std::uint64_t part)
{
  return size / part + (size % part != 0 ? 1 : 0);
}

Sizes
DivideUp(const Sizes & sizes, const Sizes & parts)
{
  Sizes numbers(sizes.size());
  std::transform(sizes.begin(), sizes.end(), parts.begin(), numbers.begin(), [](auto size, auto part) {
    return DivideUp(size, part);
  });
  return numbers;
}

/** The product, or the largest number where it does not fit. */
std::uint64_t
MultiplySaturated(const std::uint64_t a, const std::uint64_t b)
{
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  return b != 0 && a > most / b ? most : a * b;
}

std::uint64_t
GetProduct(const Sizes & sizes)
{
  std::uint64_t product = 1;
  for (const std::uint64_t size : sizes)
  {
    product = MultiplySaturated(product, size);
  }
  return product;
}

/** Cuts an axis into parts of at most the given size that are as equal as can be. */
std::uint64_t
SplitEvenly(const std::uint64_t size, const std::uint64_t most)
{
  return DivideUp(size, DivideUp(size, most));
}

/** The largest tiles that suit the caches. */
Sizes
GetLargestTile(const Sizes & parents, const Flags & subdivided, const TileAxes & axes)
{
  Sizes      tile = parents;
  const bool isSwept = axes.HasZ() || subdivided[axes.X];
  if (isSwept)
  {
    tile[axes.X] = SplitEvenly(tile[axes.X], axes.HasY() ? WidthOfPlanes : WidthOfRows);
  }
  if (axes.HasY())
  {
    tile[axes.Y] = SplitEvenly(tile[axes.Y], HeightOfPlanes);
  }
  for (std::size_t axis = tile.size(); axis-- > 0;)
  {
    if (!subdivided[axis] && !(isSwept && axis == axes.X))
    {
      tile[axis] = 1;
      tile[axis] = SplitEvenly(parents[axis], std::max<std::uint64_t>(Morsel / GetProduct(tile), 1));
    }
  }
  return tile;
}

/** Of tile sizes up to the largest one, parts of it along y and z, the one with which the threads are done first: with
 * little halo, and none of them idle at the end. */
Sizes
BalanceTile(const Sizes &       parents,
            const Sizes &       largest,
            const TileAxes &    axes,
            const std::uint64_t radius,
            const std::uint64_t threads)
{
  // No more parts of y than that many beyond the fewest: with so many tiles there is nothing left to balance.
  constexpr std::uint64_t mostMoreParts = 64;
  const std::uint64_t     fewestYParts = axes.HasY() ? DivideUp(parents[axes.Y], largest[axes.Y]) : 1;
  const std::uint64_t     mostYParts = axes.HasY() ? fewestYParts + std::min(fewestYParts, mostMoreParts) : 1;
  const std::uint64_t     shortest = 4 * std::max<std::uint64_t>(radius, 1);
  const std::uint64_t     mostZParts = std::max<std::uint64_t>(std::min(parents[axes.Z] / shortest, threads), 1);

  Sizes  best = largest;
  double leastTime = std::numeric_limits<double>::infinity();
  for (std::uint64_t yParts = fewestYParts; yParts <= mostYParts; ++yParts)
  {
    for (std::uint64_t zParts = 1; zParts <= mostZParts; ++zParts)
    {
      Sizes tile = largest;
      if (axes.HasY())
      {
        tile[axes.Y] = DivideUp(parents[axes.Y], yParts);
      }
      tile[axes.Z] = DivideUp(parents[axes.Z], zParts);
      const std::uint64_t rounds = DivideUp(GetProduct(DivideUp(parents, tile)), threads);
      // About half of the work extends over the halo on both sides.
      const std::uint64_t rows = axes.HasY() ? tile[axes.Y] + radius : 1;
      const double        time = static_cast<double>(rounds) * static_cast<double>(rows) *
                          (static_cast<double>(tile[axes.Z]) + static_cast<double>(radius));
      if (time < leastTime)
      {
        leastTime = time;
        best = tile;
      }
    }
  }
  return best;
}

void
CheckArguments(const Sizes & parents, const Flags & subdivided, const int radius)
{
  if (parents.size() != subdivided.size())
  {
    throw std::invalid_argument("there are " + std::to_string(parents.size()) + " sizes, but flags for " +
                                std::to_string(subdivided.size()) + " axes");
  }
  if (radius < 0)
  {
    throw std::invalid_argument("the radius is " + std::to_string(radius) + ", but must not be negative");
  }
  for (const std::uint64_t size : parents)
  {
    if (size == 0)
    {
      throw std::invalid_argument("a size is 0, but must be at least 1");
    }
    CheckedSigned(size);
  }
}

} // namespace

Tiling::Tiling(Sizes parents, Flags subdivided, const int radius, const unsigned int threads)
  : m_Parents(std::move(parents))
{
  CheckArguments(m_Parents, subdivided, radius);
  const TileAxes axes(subdivided);
  m_TileSize = GetLargestTile(m_Parents, subdivided, axes);
  if (axes.HasZ())
  {
    m_TileSize = BalanceTile(m_Parents, m_TileSize, axes, static_cast<std::uint64_t>(radius), std::max(threads, 1u));
  }
  m_Tiles = DivideUp(m_Parents, m_TileSize);
  std::uint64_t number = 1;
  for (const std::uint64_t tiles : m_Tiles)
  {
    number = CheckedMultiply(number, tiles);
  }
  if (static_cast<std::size_t>(number) != number)
  {
    throw std::overflow_error("there are more tiles than this machine counts");
  }
}

std::size_t
Tiling::GetNumberOfTiles() const
{
  return GetProduct(m_Tiles);
}

Box
Tiling::GetTile(std::size_t number) const
{
  Box tile;
  for (std::size_t axis = 0; axis < m_Parents.size(); ++axis)
  {
    const std::uint64_t first = number % m_Tiles[axis] * m_TileSize[axis];
    number /= m_Tiles[axis];
    tile.push_back({ static_cast<std::int64_t>(first), std::min(m_TileSize[axis], m_Parents[axis] - first) });
  }
  return tile;
}

const Sizes &
Tiling::GetTileSize() const
{
  return m_TileSize;
}

} // namespace Subdivision
} // namespace itk
