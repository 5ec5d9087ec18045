// SPDX-License-Identifier: Apache-2.0
#include "array/Elements.h"

#include <cstring>

namespace itk
{
namespace Subdivision
{
namespace
{

template <typename TElement>
TElement
Load(const unsigned char * const memory)
{
  TElement element;
  std::memcpy(&element, memory, sizeof(element));
  return element;
}

template <std::size_t VBytes>
void
CopyElementsOf(const unsigned char * from,
               const std::ptrdiff_t  fromStep,
               const std::size_t     count,
               unsigned char *       to,
               const std::ptrdiff_t  toStep)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto position = static_cast<std::ptrdiff_t>(i);
    std::memcpy(to + position * toStep, from + position * fromStep, VBytes);
  }
}

} // namespace

template <typename TReal>
void
Gather(const ElementType     type,
       const unsigned char * elements,
       const std::ptrdiff_t  step,
       const std::size_t     count,
       TReal *               values)
{
  WithElementType(type, [=](const auto tag) {
    using Element = typename decltype(tag)::Type;
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] = static_cast<TReal>(Load<Element>(elements + static_cast<std::ptrdiff_t>(i) * step));
    }
  });
}

template <typename TReal>
void
GatherAt(const ElementType                   type,
         const unsigned char *               elements,
         const std::vector<std::ptrdiff_t> & offsets,
         TReal *                             values)
{
  WithElementType(type, [&offsets, elements, values](const auto tag) {
    using Element = typename decltype(tag)::Type;
    TReal * value = values;
    for (const std::ptrdiff_t offset : offsets)
    {
      *value++ = static_cast<TReal>(Load<Element>(elements + offset));
    }
  });
}

void
CopyElements(const std::size_t     bytes,
             const unsigned char * from,
             const std::ptrdiff_t  fromStep,
             const std::size_t     count,
             unsigned char *       to,
             const std::ptrdiff_t  toStep)
{
  const auto size = static_cast<std::ptrdiff_t>(bytes);
  if (fromStep == size && toStep == size)
  {
    std::memcpy(to, from, count * bytes);
    return;
  }
  switch (bytes)
  {
    case 1:
      return CopyElementsOf<1>(from, fromStep, count, to, toStep);
    case 2:
      return CopyElementsOf<2>(from, fromStep, count, to, toStep);
    case 4:
      return CopyElementsOf<4>(from, fromStep, count, to, toStep);
    default:
      return CopyElementsOf<8>(from, fromStep, count, to, toStep);
  }
}

template void
Gather(ElementType, const unsigned char *, std::ptrdiff_t, std::size_t, float *);
template void
Gather(ElementType, const unsigned char *, std::ptrdiff_t, std::size_t, double *);

template void
GatherAt(ElementType, const unsigned char *, const std::vector<std::ptrdiff_t> &, float *);
template void
GatherAt(ElementType, const unsigned char *, const std::vector<std::ptrdiff_t> &, double *);

} // namespace Subdivision
} // namespace itk
