// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/DefaultFloatingPoint.h"

namespace itk
{
namespace Subdivision
{

DefaultFloatingPoint::DefaultFloatingPoint()
{
  std::fegetenv(&m_Former);
  std::fesetenv(FE_DFL_ENV);
}

DefaultFloatingPoint::~DefaultFloatingPoint() { std::fesetenv(&m_Former); }

} // namespace Subdivision
} // namespace itk
