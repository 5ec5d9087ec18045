// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_Tiling_h
#define NonOscillatorySubdivision_Tiling_h

#include "NonOscillatorySubdivision/ArrayView.h"
#include "NonOscillatorySubdivisionExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{
namespace Subdivision
{

using Sizes = std::vector<std::uint64_t>;
using Flags = std::vector<bool>;

/** \brief The tiles of a run: disjoint boxes of parents that cover all of them, small enough for the kernel's caches
 * and large enough to keep the halo small, balanced over the threads. */
class NonOscillatorySubdivision_EXPORT Tiling
{
public:
  /** \param parents the size along each axis, none of them 0
   * \param subdivided the axes that are subdivided, three at most
   * \param radius the scheme's
   * \param threads how many threads compute tiles at once */
  Tiling(Sizes parents, Flags subdivided, int radius, unsigned int threads);

  std::size_t
  GetNumberOfTiles() const;

  /** Counted from 0 along every axis. */
  Box
  GetTile(std::size_t number) const;

  /** The largest tile's size. */
  const Sizes &
  GetTileSize() const;

private:
  Sizes m_Parents;
  Sizes m_TileSize;
  Sizes m_Tiles;
};

} // namespace Subdivision
} // namespace itk

#endif
