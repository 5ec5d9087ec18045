// SPDX-License-Identifier: Apache-2.0
#ifndef OutputMemory_h
#define OutputMemory_h

#include "NonOscillatorySubdivision/ArrayView.h"

namespace itk
{
namespace Subdivision
{

/** Has large outputs that were not touched yet lie on huge pages. */
void
AdviseHugePages(const ArrayView & output);

} // namespace Subdivision
} // namespace itk

#endif
