// SPDX-License-Identifier: Apache-2.0
#include "array/LabelBlock.h"

#include "array/LabelTypes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace itk
{
namespace Subdivision
{
namespace
{

/** Elements from the array's first one; or that the boundary has to be asked. */
constexpr std::ptrdiff_t Outside = std::numeric_limits<std::ptrdiff_t>::min();

/** Where the voxels of a block lie along one of its axes. */
std::vector<std::ptrdiff_t>
FindOffsets(const ArrayAxis & axis,
            const Interval &  whole,
            const Boundary &  boundary,
            const Interval &  voxels,
            const int         halo)
{
  std::vector<std::ptrdiff_t> offsets;
  const auto                  size = static_cast<std::int64_t>(whole.Size);
  const auto                  count = static_cast<std::int64_t>(voxels.Size) + 2 * halo;
  // Counted from the image's first voxel, so that no index overflows.
  const std::int64_t first = voxels.First - whole.First - halo;
  const std::int64_t stored = axis.First - whole.First;
  for (std::int64_t i = first; i < first + count; ++i)
  {
    const bool isInside = i >= 0 && i < size;
    if (!isInside && !boundary.MapsIndices())
    {
      offsets.push_back(Outside);
    }
    else
    {
      const std::int64_t index = isInside ? i : boundary.MapIndex(i, size);
      // Voxels that no child depends on need not be there: any other stands for them.
      const std::int64_t held = std::clamp<std::int64_t>(index - stored, 0, static_cast<std::int64_t>(axis.Size) - 1);
      offsets.push_back(static_cast<std::ptrdiff_t>(held) * axis.Stride);
    }
  }
  return offsets;
}

/** Positions from the first to the end of the longest part whose elements lie side by side; empty where all lie
 * outside. */
std::pair<std::size_t, std::size_t>
FindDensePart(const std::vector<std::ptrdiff_t> & offsets)
{
  std::pair<std::size_t, std::size_t> longest{ 0, 0 };
  for (std::size_t begin = 0; begin < offsets.size();)
  {
    std::size_t end = begin + 1;
    while (end < offsets.size() && offsets[begin] != Outside && offsets[end] == offsets[end - 1] + 1)
    {
      ++end;
    }
    if (offsets[begin] != Outside && end - begin > longest.second - longest.first)
    {
      longest = { begin, end };
    }
    begin = end;
  }
  return longest;
}

template <typename T>
T
ToLabel(const double value)
{
  const double beyond = std::ldexp(1.0, std::numeric_limits<T>::digits);
  if (!(value >= static_cast<double>(std::numeric_limits<T>::lowest()) && value < beyond && value == std::floor(value)))
  {
    throw std::range_error("the boundary's value " + std::to_string(value) + " is no label of the input's type");
  }
  // From 2^53 on, a double stands for several integers: another label than the one that was meant.
  if (std::abs(value) >= std::ldexp(1.0, std::numeric_limits<double>::digits))
  {
    throw std::range_error("the boundary's label " + std::to_string(value) + " is too large: it must be below 2^53");
  }
  return static_cast<T>(value);
}

/** What the boundary supplies at an index. */
template <typename T>
T
AskBoundary(const Boundary & boundary, const Box & whole, const std::vector<std::int64_t> & index)
{
  const std::vector<double> & constants = boundary.GetConstants();
  if (!constants.empty())
  {
    const auto component =
      constants.size() > 1 ? static_cast<std::size_t>(index[0] - whole[0].First) : std::size_t{ 0 };
    return ToLabel<T>(constants[component]);
  }
  return ToLabel<T>(boundary.GetElements()->GetElement(index.data()));
}

} // namespace

LabelBlockAxes
LabelBlockAxes::Choose(const std::vector<bool> & subdivided, const Box & whole)
{
  std::vector<int> others;
  int              x = -1;
  for (int axis = 0; axis < static_cast<int>(whole.size()); ++axis)
  {
    if (x < 0 && (whole[axis].Size > 1 || subdivided[axis]))
    {
      x = axis;
    }
    else if (subdivided[axis])
    {
      others.push_back(axis);
    }
  }
  if (others.size() > 2)
  {
    x = others.front();
    others.erase(others.begin());
  }
  LabelBlockAxes axes{ { std::max(x, 0), -1, -1 }, { subdivided[std::max(x, 0)], false, false } };
  if (!others.empty())
  {
    axes.Number[2] = others.back();
    axes.IsSubdivided[2] = true;
  }
  if (others.size() > 1)
  {
    axes.Number[1] = others.front();
    axes.IsSubdivided[1] = true;
  }
  return axes;
}

template <typename T>
void
GatherLabels(const ConstArrayView &  input,
             const Box &             whole,
             const Boundary &        boundary,
             const LabelBlockAxes &  axes,
             const LabelBlockPlace & place,
             std::vector<T> &        labels)
{
  const T *                                  data = static_cast<const T *>(input.Data);
  std::array<std::vector<std::ptrdiff_t>, 3> offsets{ { { 0 }, { 0 }, { 0 } } };
  for (std::size_t axis = 0; axis < input.Axes.size(); ++axis)
  {
    const auto tileAxis =
      std::find(axes.Number.begin(), axes.Number.end(), static_cast<int>(axis)) - axes.Number.begin();
    if (tileAxis < 3)
    {
      offsets[tileAxis] =
        FindOffsets(input.Axes[axis], whole[axis], boundary, place.Voxels[tileAxis], place.Halo[tileAxis]);
    }
    else
    {
      data += static_cast<std::ptrdiff_t>(place.Position[axis] - input.Axes[axis].First) * input.Axes[axis].Stride;
    }
  }

  const std::pair<std::size_t, std::size_t> dense = FindDensePart(offsets[0]);
  labels.resize(offsets[0].size() * offsets[1].size() * offsets[2].size());
  T *                       out = labels.data();
  std::vector<std::int64_t> index = place.Position;
  const auto                setIndex = [&](const int tileAxis, const std::size_t i) {
    if (axes.Number[tileAxis] >= 0)
    {
      index[axes.Number[tileAxis]] = place.Voxels[tileAxis].First - place.Halo[tileAxis] + static_cast<std::int64_t>(i);
    }
  };
  for (std::size_t z = 0; z < offsets[2].size(); ++z)
  {
    setIndex(2, z);
    for (std::size_t y = 0; y < offsets[1].size(); ++y)
    {
      setIndex(1, y);
      const bool      isOutside = offsets[2][z] == Outside || offsets[1][y] == Outside;
      const T * const row = isOutside ? nullptr : data + offsets[2][z] + offsets[1][y];
      std::size_t     x = 0;
      const auto      copyUntil = [&](const std::size_t end) {
        for (; x < end; ++x)
        {
          if (row != nullptr && offsets[0][x] != Outside)
          {
            *out++ = row[offsets[0][x]];
          }
          else
          {
            setIndex(0, x);
            *out++ = AskBoundary<T>(boundary, whole, index);
          }
        }
      };
      if (row != nullptr && dense.first < dense.second)
      {
        copyUntil(dense.first);
        out = std::copy_n(row + offsets[0][x], dense.second - dense.first, out);
        x = dense.second;
      }
      copyUntil(offsets[0].size());
    }
  }
}

template <typename T>
void
FindMixed(const std::vector<T> &             labels,
          const std::array<std::size_t, 3> & length,
          const std::array<bool, 3> &        subdivided,
          std::vector<std::uint8_t> &        mixed)
{
  const std::size_t         count = labels.size();
  std::vector<std::uint8_t> before;
  mixed.assign(count, 0);
  std::size_t stride = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (subdivided[axis] && length[axis] > 2)
    {
      before = mixed;
      const T * const            label = labels.data();
      const std::uint8_t * const was = before.data();
      std::uint8_t * const       is = mixed.data();
      for (std::size_t i = stride; i < count - stride; ++i)
      {
        is[i] = static_cast<std::uint8_t>(was[i - stride] | was[i] | was[i + stride] | (label[i - stride] != label[i]) |
                                          (label[i + stride] != label[i]));
      }
    }
    stride *= length[axis];
  }
}

#define SubdivisionInstantiateLabelBlock(T)                      \
  template void GatherLabels<T>(const ConstArrayView &,          \
                                const Box &,                     \
                                const Boundary &,                \
                                const LabelBlockAxes &,          \
                                const LabelBlockPlace &,         \
                                std::vector<T> &);               \
  template void FindMixed<T>(const std::vector<T> &,             \
                             const std::array<std::size_t, 3> &, \
                             const std::array<bool, 3> &,        \
                             std::vector<std::uint8_t> &)
SubdivisionForEachLabelType(SubdivisionInstantiateLabelBlock);
#undef SubdivisionInstantiateLabelBlock

} // namespace Subdivision
} // namespace itk
