// SPDX-License-Identifier: Apache-2.0
#ifndef BoxRuns_h
#define BoxRuns_h

#include "volumes/ImageDescription.h"

#include <cstdint>
#include <stdexcept>
#include <vector>

/** Calls a function with the number of the first voxel, and the number of voxels, of each run of a box that has no gap
 * in an image, in order.
 * \throw std::out_of_range if the box is not within the image */
template <typename TFunction>
void
ForEachRun(const std::vector<std::uint64_t> & size, const itk::Subdivision::Box & box, TFunction && function)
{
  if (box.size() != size.size())
  {
    throw std::out_of_range("a box with another number of axes than its image");
  }
  for (std::size_t axis = 0; axis < size.size(); ++axis)
  {
    if (box[axis].First < 0 || static_cast<std::uint64_t>(box[axis].First) > size[axis] ||
        box[axis].Size > size[axis] - static_cast<std::uint64_t>(box[axis].First) || box[axis].Size == 0)
    {
      throw std::out_of_range("a box that is not within its image");
    }
  }
  // The axes of a run: those of which the box has all, and the next one.
  std::size_t   inner = 0;
  std::uint64_t run = 1;
  std::uint64_t stride = 1;
  while (inner < size.size() && box[inner].Size == size[inner])
  {
    run *= size[inner++];
  }
  run *= inner < size.size() ? box[inner].Size : 1;
  const std::size_t          outer = inner + 1;
  std::vector<std::uint64_t> strides;
  std::uint64_t              first = 0;
  for (std::size_t axis = 0; axis < size.size(); ++axis)
  {
    strides.push_back(stride);
    first += stride * static_cast<std::uint64_t>(box[axis].First);
    stride *= size[axis];
  }
  std::vector<std::uint64_t> index(size.size(), 0);
  for (;;)
  {
    std::uint64_t place = first;
    for (std::size_t axis = outer; axis < size.size(); ++axis)
    {
      place += strides[axis] * index[axis];
    }
    function(place, run);
    std::size_t axis = outer;
    while (axis < size.size() && ++index[axis] == box[axis].Size)
    {
      index[axis++] = 0;
    }
    if (axis >= size.size())
    {
      return;
    }
  }
}

#endif
