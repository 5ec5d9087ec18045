// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/DefaultFloatingPoint.h"

#ifdef NonOscillatorySubdivision_HAS_MXCSR
#  include <xmmintrin.h>
#endif

namespace itk
{
namespace Subdivision
{

DefaultFloatingPoint::DefaultFloatingPoint()
{
#ifdef NonOscillatorySubdivision_HAS_MXCSR
  // The C library of mingw-w64 sets the x87 only.
  m_FormerControl = _mm_getcsr();
  _mm_setcsr(0x1F80);
#endif
  std::fegetenv(&m_Former);
  std::fesetenv(FE_DFL_ENV);
}

DefaultFloatingPoint::~DefaultFloatingPoint()
{
  std::fesetenv(&m_Former);
#ifdef NonOscillatorySubdivision_HAS_MXCSR
  _mm_setcsr(m_FormerControl);
#endif
}

} // namespace Subdivision
} // namespace itk
