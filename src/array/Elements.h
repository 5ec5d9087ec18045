// SPDX-License-Identifier: Apache-2.0
#ifndef Elements_h
#define Elements_h

#include "NonOscillatorySubdivision/ElementType.h"

#include <cstddef>
#include <vector>

namespace itk
{
namespace Subdivision
{

// Elements that do not lie side by side. Steps from one to the next are in bytes, of either sign or 0.

/** Makes a real value of each element. */
template <typename TReal>
void
Gather(ElementType type, const unsigned char * elements, std::ptrdiff_t step, std::size_t count, TReal * values);

/** Makes a real value of each element at an offset in bytes. */
template <typename TReal>
void
GatherAt(ElementType type, const unsigned char * elements, const std::vector<std::ptrdiff_t> & offsets, TReal * values);

/** Copies elements of the given number of bytes as they are. */
void
CopyElements(std::size_t           bytes,
             const unsigned char * from,
             std::ptrdiff_t        fromStep,
             std::size_t           count,
             unsigned char *       to,
             std::ptrdiff_t        toStep);

extern template void
Gather(ElementType, const unsigned char *, std::ptrdiff_t, std::size_t, float *);
extern template void
Gather(ElementType, const unsigned char *, std::ptrdiff_t, std::size_t, double *);

extern template void
GatherAt(ElementType, const unsigned char *, const std::vector<std::ptrdiff_t> &, float *);
extern template void
GatherAt(ElementType, const unsigned char *, const std::vector<std::ptrdiff_t> &, double *);

} // namespace Subdivision
} // namespace itk

#endif
