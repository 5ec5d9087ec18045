// SPDX-License-Identifier: Apache-2.0
#ifndef TileAxes_h
#define TileAxes_h

#include "NonOscillatorySubdivision/Tiling.h"

#include <cstddef>
#include <limits>

namespace itk
{
namespace Subdivision
{

/** \brief Which of some axes are x, y and z of the tiles of a run.
 *
 * x is the first axis, whether it is subdivided or carried, unless three others are subdivided: then it is the first
 * of these. z is the last other subdivided axis, y the one between. Along all other axes, every position is an image
 * of its own. */
struct TileAxes
{
  static constexpr std::size_t None = std::numeric_limits<std::size_t>::max();

  std::size_t X{ 0 };
  std::size_t Y{ None };
  std::size_t Z{ None };

  /** \throw std::invalid_argument if more than three axes are subdivided, or there is none at all */
  explicit TileAxes(const Flags & subdivided);

  bool
  HasY() const
  {
    return Y != None;
  }

  bool
  HasZ() const
  {
    return Z != None;
  }

  bool
  Has(const std::size_t axis) const
  {
    return axis == X || axis == Y || axis == Z;
  }

  /** Calls \c visit with each position of a box along the axes that are not x, y or z, and the first along those. */
  template <typename TVisitor>
  void
  ForEachImage(const Box & box, const TVisitor & visit) const
  {
    std::vector<std::int64_t> position;
    for (const Interval & interval : box)
    {
      position.push_back(interval.First);
    }
    std::size_t axis = 0;
    while (axis < box.size())
    {
      visit(position);
      for (axis = 0; axis < box.size(); ++axis)
      {
        if (!this->Has(axis) && ++position[axis] < box[axis].First + static_cast<std::int64_t>(box[axis].Size))
        {
          break;
        }
        position[axis] = box[axis].First;
      }
    }
  }
};

} // namespace Subdivision
} // namespace itk

#endif
