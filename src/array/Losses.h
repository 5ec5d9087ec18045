// SPDX-License-Identifier: Apache-2.0
#ifndef Losses_h
#define Losses_h

#include "NonOscillatorySubdivision/ElementType.h"

#include <cstddef>

namespace itk
{
namespace Subdivision
{

/** How many real values elements of an integer type could not hold. */
struct Losses
{
  std::size_t NotANumber; // became 0
  std::size_t Clamped;    // became the type's least or greatest number
};

/** Whether there is, among elements that were made of real values, one that may not be what its value was: a limit of
 * its type or, if \c zeroMayBeNaN, 0. */
bool
MayHaveLost(ElementType integers, const void * elements, std::size_t count, bool zeroMayBeNaN);

template <typename TReal>
Losses
CountLosses(ElementType integers, const TReal * values, std::size_t count);

extern template Losses
CountLosses<float>(ElementType, const float *, std::size_t);
extern template Losses
CountLosses<double>(ElementType, const double *, std::size_t);

} // namespace Subdivision
} // namespace itk

#endif
