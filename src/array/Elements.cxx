// SPDX-License-Identifier: Apache-2.0
#include "array/Elements.h"

#include <cstring>

namespace itk
{
namespace Subdivision
{
namespace
{

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
    typename decltype(tag)::Type element;
    for (std::size_t i = 0; i < count; ++i)
    {
      std::memcpy(&element, elements + static_cast<std::ptrdiff_t>(i) * step, sizeof(element));
      values[i] = static_cast<TReal>(element);
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

} // namespace Subdivision
} // namespace itk
