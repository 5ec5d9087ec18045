// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_LabelBlock_h
#define NonOscillatorySubdivision_LabelBlock_h

#include "NonOscillatorySubdivision/Boundary.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{
namespace Subdivision
{

/** \brief The axes of blocks: x, y, z of the kernel's tiles, as numbers of axes of the array; -1 where there is none.
 */
struct LabelBlockAxes
{
  std::array<int, 3>  Number;
  std::array<bool, 3> IsSubdivided;

  /** x is the first axis that is longer than 1, carried if it is not subdivided, unless three other axes are; z is the
   * last other subdivided axis. */
  static LabelBlockAxes
  Choose(const std::vector<bool> & subdivided, const Box & whole);
};

/** \brief A block of voxels and its halo, of one image: a position along every axis that is not the block's. */
struct LabelBlockPlace
{
  /** Along x, y, z; First is an index of the array, 0 without that axis. Without the halo. */
  std::array<Interval, 3> Voxels;
  std::array<int, 3>      Halo;
  /** An index for each axis of the array; those of the block's axes do not matter. */
  std::vector<std::int64_t> Position;

  /** With the halo. */
  std::size_t
  GetLength(int axis) const
  {
    return static_cast<std::size_t>(Voxels[axis].Size) + 2 * static_cast<std::size_t>(Halo[axis]);
  }
};

/** Gathers the labels of a block and of its halo, x fastest; those outside \c whole come from the boundary.
 * \throw std::range_error if the boundary supplies what is no label of the type */
template <typename T>
void
GatherLabels(const ConstArrayView &  input,
             const Box &             whole,
             const Boundary &        boundary,
             const LabelBlockAxes &  axes,
             const LabelBlockPlace & place,
             std::vector<T> &        labels);

/** Of voxels side by side (x fastest, then y and z), which have a neighbour of another label in the 3^d voxels around
 * them, along the subdivided axes. Those at the faces are not to be used.
 * \param length the voxels along each axis */
template <typename T>
void
FindMixed(const std::vector<T> &             labels,
          const std::array<std::size_t, 3> & length,
          const std::array<bool, 3> &        subdivided,
          std::vector<std::uint8_t> &        mixed);

} // namespace Subdivision
} // namespace itk

#endif
