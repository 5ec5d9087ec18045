// SPDX-License-Identifier: Apache-2.0
#include "itkNonOscillatorySubdivisionImageFilterEnums.h"

namespace itk
{

std::ostream &
operator<<(std::ostream & out, const NonOscillatorySubdivisionImageFilterEnums::Scheme value)
{
  constexpr const char * prefix = "itk::NonOscillatorySubdivisionImageFilterEnums::Scheme::";
  using Scheme = NonOscillatorySubdivisionImageFilterEnums::Scheme;
  switch (value)
  {
    case Scheme::NonOscillatory:
      return out << prefix << "NonOscillatory";
    case Scheme::Linear:
      return out << prefix << "Linear";
    case Scheme::BoundedLinear:
      return out << prefix << "BoundedLinear";
    case Scheme::BSpline:
      return out << prefix << "BSpline";
    case Scheme::Restored:
      return out << prefix << "Restored";
  }
  return out << "INVALID VALUE FOR " << prefix;
}

} // namespace itk
