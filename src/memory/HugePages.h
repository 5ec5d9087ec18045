// SPDX-License-Identifier: Apache-2.0
#ifndef HugePages_h
#define HugePages_h

#include "NonOscillatorySubdivisionExport.h"

#include <cstddef>
#include <memory>

namespace itk
{
namespace Subdivision
{

/** Advises the system to back memory that was not touched yet with huge pages, where it offers them and where the
 * memory is large enough to gain from them; does nothing elsewhere. A large output costs more for its first touch, page
 * by page, than for its arithmetic. */
NonOscillatorySubdivision_EXPORT void
AdviseHugePages(void * memory, std::size_t bytes);

/** Memory that releases itself. */
struct FreeMemory
{
  NonOscillatorySubdivision_EXPORT void
  operator()(void * memory) const;
};
using HugePageMemory = std::unique_ptr<void, FreeMemory>;

/** Untouched memory, aligned to cache lines at least and advised to lie on huge pages.
 * \throw std::bad_alloc */
NonOscillatorySubdivision_EXPORT HugePageMemory
AllocateOnHugePages(std::size_t bytes);

} // namespace Subdivision
} // namespace itk

#endif
