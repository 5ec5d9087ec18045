// SPDX-License-Identifier: Apache-2.0
#ifndef itkCopyPastCache_h
#define itkCopyPastCache_h

#include "NonOscillatorySubdivisionExport.h"

#include <cstddef>

namespace itk
{

/** Copies bytes to memory that nobody reads soon. Where the processor can do so, whole cache lines go there without
 * being read first and without taking the place of what is in the cache; elsewhere this is a plain copy. Other threads
 * may read them after FinishCopiesPastCache() on this one. */
NonOscillatorySubdivision_EXPORT void
CopyPastCache(const void * from, std::size_t bytes, void * to);

/** Makes this thread's copies visible before all that it writes from now on. */
NonOscillatorySubdivision_EXPORT void
FinishCopiesPastCache();

} // namespace itk

#endif
