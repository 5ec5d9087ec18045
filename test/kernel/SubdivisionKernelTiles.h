// SPDX-License-Identifier: Apache-2.0
#ifndef SubdivisionKernelTiles_h
#define SubdivisionKernelTiles_h

#include "NonOscillatorySubdivision/Kernel.h"

#include "common/SubdivisionReference.h"

#include "gtest/gtest.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

/** Tiles of values for the kernel, without images, and what the slow reference makes of them. */
namespace SubdivisionKernelTiles
{
namespace Reference = SubdivisionReference;
using namespace itk::Subdivision;
using Index3 = Reference::Index<3>;
using Grid3 = Reference::Grid<3>;

constexpr int NumberOfSchemes = 5;

/** What lies within and around a tile. */
template <typename T>
struct TestTile : RowSource<T>
{
  TestTile(const Scheme & scheme, const Axes & axes, const TileSize & size)
    : Size(size)
  {
    const long        radius = scheme.Radius();
    const bool        subdivided[] = { axes.X, axes.Y, axes.Z };
    const std::size_t sizes[] = { size.X, size.Y, size.Z };
    Index3            lower;
    Index3            whole;
    for (int w = 0; w < 3; ++w)
    {
      Halo[w] = subdivided[w] ? radius : 0;
      lower[w] = -Halo[w];
      whole[w] = static_cast<long>(sizes[w]) + 2 * Halo[w];
      Factor[w] = subdivided[w] ? 2 : 1;
    }
    Values = Grid3(lower, whole);
  }

  void
  ReadRow(const std::ptrdiff_t y, const std::ptrdiff_t z, T * const values) override
  {
    if (RowsUntilThrow > 0 && --RowsUntilThrow == 0)
    {
      throw std::runtime_error("source");
    }
    for (long x = 0; x < Values.size[0]; ++x)
    {
      values[x] = static_cast<T>(Values({ Values.lower[0] + x, static_cast<long>(y), static_cast<long>(z) }));
    }
  }

  TileSize Size;
  Index3   Halo{};
  Index3   Factor{};
  Grid3    Values;
  int      RowsUntilThrow{ 0 };
};

/** Keeps children, each of which must come once. */
template <typename T>
struct TestChildren : RowSink<T>
{
  explicit TestChildren(const TestTile<T> & tile)
    : Size{ static_cast<long>(tile.Size.X) * tile.Factor[0],
            static_cast<long>(tile.Size.Y) * tile.Factor[1],
            static_cast<long>(tile.Size.Z) * tile.Factor[2] }
    , Values(static_cast<std::size_t>(Size[0] * Size[1] * Size[2]))
    , Rows(static_cast<std::size_t>(Size[1] * Size[2]))
  {}

  void
  WriteRow(const std::ptrdiff_t y, const std::ptrdiff_t z, const ChildRow<T> & children) override
  {
    if (RowsUntilThrow > 0 && --RowsUntilThrow == 0)
    {
      throw std::runtime_error("sink");
    }
    ASSERT_EQ(static_cast<std::size_t>(Size[0]), children.GetSize());
    ++Rows.at(static_cast<std::size_t>(z * Size[1] + y));
    children.CopyTo(ElementTypeOf<T>(), &Values.at(static_cast<std::size_t>((z * Size[1] + y) * Size[0])));
  }

  void
  ExpectEachRowOnce() const
  {
    for (const int row : Rows)
    {
      ASSERT_EQ(1, row);
    }
  }

  T
  At(const Index3 & index) const
  {
    return Values.at(static_cast<std::size_t>((index[2] * Size[1] + index[1]) * Size[0] + index[0]));
  }

  Index3           Size;
  std::vector<T>   Values;
  std::vector<int> Rows;
  int              RowsUntilThrow{ 0 };
};

/** Smooth parts, noise and flat blocks. */
template <typename T>
void
FillRandomly(TestTile<T> & tile, const unsigned int seed)
{
  std::mt19937                           generator(seed);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  Reference::ForEachIndex<3>(tile.Values.lower, tile.Values.size, [&](const Index3 & i) {
    const double smooth =
      40 * std::sin(0.3 * static_cast<double>(i[0])) + 20 * std::cos(0.4 * static_cast<double>(i[1] + i[2]));
    const bool isFlat = (i[0] + 64) / 9 % 3 == 0;
    tile.Values(i) = isFlat ? 25.0 : static_cast<T>(smooth + 10 * noise(generator));
  });
}

/** The scheme by its sums, on what the tile reads; the boundary is never asked. */
template <typename T>
Grid3
ComputeReference(const TestTile<T> & tile, const int scheme, const double tension, const Axes & axes)
{
  Reference::Settings<3> settings;
  settings.scheme = static_cast<Reference::Scheme>(scheme);
  settings.tension = tension;
  settings.axes = { axes.X, axes.Y, axes.Z };
  Grid3 image({ 0, 0, 0 },
              { static_cast<long>(tile.Size.X), static_cast<long>(tile.Size.Y), static_cast<long>(tile.Size.Z) });
  // The reference reads five voxels to either side whatever the scheme needs.
  settings.boundary = [&tile](const Grid3 &, const Index3 & index) {
    Index3 inside = index;
    for (int w = 0; w < 3; ++w)
    {
      const long first = tile.Values.lower[w];
      inside[w] = std::min(std::max(index[w], first), first + tile.Values.size[w] - 1);
    }
    return tile.Values(inside);
  };
  return Reference::Subdivide<3>(image, settings);
}

template <typename T>
TestChildren<T>
Compute(Kernel<T> & kernel, TestTile<T> & tile)
{
  TestChildren<T> children(tile);
  kernel.Subdivide(tile.Size, tile, children);
  children.ExpectEachRowOnce();
  return children;
}

template <typename T>
void
ExpectReference(const std::string & target,
                const int           scheme,
                const double        tension,
                const Axes &        axes,
                const TileSize &    size)
{
  SCOPED_TRACE(target + " " + Schemes[scheme].Name + " " + std::to_string(size.X) + "x" + std::to_string(size.Y) + "x" +
               std::to_string(size.Z) + " axes " + std::to_string(axes.X) + std::to_string(axes.Y) +
               std::to_string(axes.Z));
  TestTile<T> tile(Schemes[scheme], axes, size);
  FillRandomly(tile, static_cast<unsigned>(size.X));
  Kernel<T>             kernel(Schemes[scheme], tension, axes, size, Target::Named(target));
  const TestChildren<T> children = Compute(kernel, tile);
  const Grid3           expected = ComputeReference(tile, scheme, tension, axes);
  // Values are up to 70; every pass rounds them, and T and K amplify what is lost of a difference.
  const double tolerance = 1e4 * static_cast<double>(std::numeric_limits<T>::epsilon());
  Reference::ForEachIndex<3>(expected.lower, expected.size, [&](const Index3 & i) {
    ASSERT_NEAR(expected(i), children.At(i), tolerance) << i[0] << " " << i[1] << " " << i[2];
  });
}

inline const Axes AllAxes[] = { { true, false, false }, { false, true, false }, { false, false, true },
                                { true, true, false },  { true, false, true },  { false, true, true },
                                { true, true, true } };

} // namespace SubdivisionKernelTiles

#endif
