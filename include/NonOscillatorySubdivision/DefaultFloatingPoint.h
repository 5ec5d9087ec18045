// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_DefaultFloatingPoint_h
#define NonOscillatorySubdivision_DefaultFloatingPoint_h

#include "NonOscillatorySubdivisionExport.h"

#include <cfenv>

#if defined(__x86_64__) || defined(_M_X64)
#  define NonOscillatorySubdivision_HAS_MXCSR
#endif

namespace itk
{
namespace Subdivision
{

/** \brief For as long as it exists, its thread rounds to nearest, keeps denormals and traps nothing; then it is as
 * before, the flags of exceptions among it.
 *
 * A caller may have chosen otherwise, and a thread begins with the choice of whoever started it, so that without this,
 * results would depend on which thread computes what. It costs less than a microsecond. */
class NonOscillatorySubdivision_EXPORT DefaultFloatingPoint
{
public:
  DefaultFloatingPoint();
  ~DefaultFloatingPoint();
  DefaultFloatingPoint(const DefaultFloatingPoint &) = delete;
  DefaultFloatingPoint &
  operator=(const DefaultFloatingPoint &) = delete;

private:
  std::fenv_t m_Former;
#ifdef NonOscillatorySubdivision_HAS_MXCSR
  unsigned int m_FormerControl; // of the vector registers
#endif
};

} // namespace Subdivision
} // namespace itk

#endif
