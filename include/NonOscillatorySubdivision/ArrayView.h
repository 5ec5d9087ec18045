// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_ArrayView_h
#define NonOscillatorySubdivision_ArrayView_h

#include "NonOscillatorySubdivision/ElementType.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{
namespace Subdivision
{

/** \brief Some indices in a row along an axis. */
struct Interval
{
  std::int64_t  First;
  std::uint64_t Size;
};

constexpr bool
operator==(const Interval & a, const Interval & b)
{
  return a.First == b.First && a.Size == b.Size;
}

constexpr bool
operator!=(const Interval & a, const Interval & b)
{
  return !(a == b);
}

/** An interval of indices along each axis, the fastest axis of an image first. */
using Box = std::vector<Interval>;

/** \brief An axis of an array: its indices, and how many elements (not bytes) its neighbours lie apart, either way. */
struct ArrayAxis
{
  std::int64_t   First;
  std::uint64_t  Size;
  std::ptrdiff_t Stride;
};

/** \brief Elements in somebody else's memory. \c Data is the element at the first index of every axis.
 *
 * Components of pixels are one more axis, the first one, which is never subdivided. */
template <typename TVoid>
struct BasicArrayView
{
  TVoid *                Data;
  ElementType            Type;
  std::vector<ArrayAxis> Axes;

  Box
  GetBox() const
  {
    Box box;
    for (const ArrayAxis & axis : Axes)
    {
      box.push_back({ axis.First, axis.Size });
    }
    return box;
  }
};

using ArrayView = BasicArrayView<void>;
using ConstArrayView = BasicArrayView<const void>;

} // namespace Subdivision
} // namespace itk

#endif
