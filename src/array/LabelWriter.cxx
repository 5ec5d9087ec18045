// SPDX-License-Identifier: Apache-2.0
#include "array/LabelWriter.h"

#include "NonOscillatorySubdivision/Geometry.h"
#include "array/LabelTypes.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace itk
{
namespace Subdivision
{
namespace
{

template <typename TOut, typename TIn>
bool
Fits(const TIn label)
{
  // Both comparisons are between numbers of the same sign.
  if (label < TIn{ 0 })
  {
    return std::is_signed<TOut>::value &&
           static_cast<std::int64_t>(label) >= static_cast<std::int64_t>(std::numeric_limits<TOut>::lowest());
  }
  return static_cast<std::uint64_t>(label) <= static_cast<std::uint64_t>(std::numeric_limits<TOut>::max());
}

} // namespace

template <typename TOut, typename TFunction>
std::size_t
LabelWriter::ForEachRow(const LabelBlockPlace & place, const TFunction & function) const
{
  TOut *                        data = static_cast<TOut *>(m_Output.Data);
  std::array<std::ptrdiff_t, 3> begin{ 0, 0, 0 };   // of the children that are asked for, in the block
  std::array<std::ptrdiff_t, 3> count{ 1, 1, 1 };   // of those
  std::array<std::ptrdiff_t, 3> inBlock{ 1, 1, 1 }; // of all children
  std::array<std::ptrdiff_t, 3> stride{ 0, 0, 0 };
  for (std::size_t axis = 0; axis < m_Output.Axes.size(); ++axis)
  {
    const ArrayAxis & asked = m_Output.Axes[axis];
    const auto        i = std::find(m_Axes.Number.begin(), m_Axes.Number.end(), static_cast<int>(axis));
    if (i == m_Axes.Number.end())
    {
      data += static_cast<std::ptrdiff_t>(place.Position[axis] - asked.First) * asked.Stride;
      continue;
    }
    const auto         tileAxis = i - m_Axes.Number.begin();
    const Interval     voxels = place.Voxels[tileAxis];
    const Interval     children = m_Axes.IsSubdivided[tileAxis] ? GetChildren(voxels) : voxels;
    const std::int64_t first = std::max(children.First, asked.First);
    const std::int64_t last = std::min(children.First + static_cast<std::int64_t>(children.Size - 1),
                                       asked.First + static_cast<std::int64_t>(asked.Size - 1));
    begin[tileAxis] = first - children.First;
    count[tileAxis] = last - first + 1;
    inBlock[tileAxis] = static_cast<std::ptrdiff_t>(children.Size);
    stride[tileAxis] = asked.Stride;
    data += static_cast<std::ptrdiff_t>(first - asked.First) * asked.Stride;
  }
  for (std::ptrdiff_t z = 0; z < count[2]; ++z)
  {
    for (std::ptrdiff_t y = 0; y < count[1]; ++y)
    {
      function(data + z * stride[2] + y * stride[1],
               count[0],
               stride[0],
               ((begin[2] + z) * inBlock[1] + begin[1] + y) * inBlock[0] + begin[0]);
    }
  }
  return static_cast<std::size_t>(count[0] * count[1] * count[2]);
}

template <typename T>
std::size_t
LabelWriter::Fill(const LabelBlockPlace & place, const T label) const
{
  return WithElementType(m_Output.Type, [&](auto tag) {
    using OutType = typename decltype(tag)::Type;
    if (!Fits<OutType>(label))
    {
      throw std::range_error("the label " + std::to_string(label) + " does not fit " + GetName(m_Output.Type));
    }
    const auto fill =
      [label](OutType * const row, const std::ptrdiff_t count, const std::ptrdiff_t stride, std::ptrdiff_t) {
        if (stride == 1)
        {
          std::fill_n(row, count, static_cast<OutType>(label));
          return;
        }
        for (std::ptrdiff_t x = 0; x < count; ++x)
        {
          row[x * stride] = static_cast<OutType>(label);
        }
      };
    return this->ForEachRow<OutType>(place, fill);
  });
}

template <typename T>
std::size_t
LabelWriter::Copy(const LabelBlockPlace & place, const std::vector<T> & labels) const
{
  return WithElementType(m_Output.Type, [&](auto tag) {
    using OutType = typename decltype(tag)::Type;
    const auto range = std::minmax_element(labels.begin(), labels.end());
    for (const T label : { *range.first, *range.second })
    {
      if (!Fits<OutType>(label))
      {
        throw std::range_error("the label " + std::to_string(label) + " does not fit " + GetName(m_Output.Type));
      }
    }
    const auto copy =
      [&](OutType * const row, const std::ptrdiff_t count, const std::ptrdiff_t stride, const std::ptrdiff_t from) {
        if (stride == 1)
        {
          // Between equal types this moves memory.
          std::copy_n(labels.data() + from, count, row);
          return;
        }
        for (std::ptrdiff_t x = 0; x < count; ++x)
        {
          row[x * stride] = static_cast<OutType>(labels[static_cast<std::size_t>(from + x)]);
        }
      };
    return this->ForEachRow<OutType>(place, copy);
  });
}

#define SubdivisionInstantiateLabelWriter(T)                                   \
  template std::size_t LabelWriter::Fill<T>(const LabelBlockPlace &, T) const; \
  template std::size_t LabelWriter::Copy<T>(const LabelBlockPlace &, const std::vector<T> &) const
SubdivisionForEachLabelType(SubdivisionInstantiateLabelWriter);
#undef SubdivisionInstantiateLabelWriter

} // namespace Subdivision
} // namespace itk
