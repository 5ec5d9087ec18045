// SPDX-License-Identifier: Apache-2.0
#include "volumes/RealVoxels.h"

#include <algorithm>

using namespace itk::Subdivision;

namespace
{
/** Reads a box whole and converts it. */
template <typename TReal>
std::uint64_t
ReadAndConvert(VolumeReader & reader, const Box & box, std::vector<char> & elements, TReal * values)
{
  const ImageDescription & image = reader.GetDescription();
  std::uint64_t            count = image.NumberOfComponents;
  for (const Interval & interval : box)
  {
    count *= interval.Size;
  }
  elements.resize(count * SizeOf(image.Component));
  reader.Read(box, elements.data());
  WithElementType(image.Component, [&](auto tag) {
    const auto * const first = reinterpret_cast<const typename decltype(tag)::Type *>(elements.data());
    std::transform(first, first + count, values, [](auto element) { return static_cast<TReal>(element); });
  });
  return count;
}
} // namespace

template <typename TReal>
void
ReadReals(VolumeReader & reader, const Box & box, TReal * values)
{
  if (reader.GetDescription().Component == ElementTypeOf<TReal>())
  {
    reader.Read(box, values);
    return;
  }
  // Plane by plane, or what there is along the last axis, so that little memory is needed beside the values.
  std::vector<char> elements;
  Box               slice = box;
  for (std::uint64_t i = 0; i < box.back().Size; ++i)
  {
    slice.back() = { box.back().First + static_cast<std::int64_t>(i), 1 };
    values += ReadAndConvert(reader, slice, elements, values);
  }
}

template void
ReadReals<float>(VolumeReader &, const Box &, float *);
template void
ReadReals<double>(VolumeReader &, const Box &, double *);
