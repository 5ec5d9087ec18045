// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/Scheme.h"

#include <cmath>
#include <stdexcept>

namespace itk
{
namespace Subdivision
{

const Scheme &
FindScheme(const std::string & name)
{
  std::string names;
  for (const Scheme & scheme : Schemes)
  {
    if (name == scheme.Name)
    {
      return scheme;
    }
    names += names.empty() ? "" : ", ";
    names += scheme.Name;
  }
  throw std::invalid_argument("no scheme \"" + name + "\"; there are: " + names);
}

void
CheckTension(const Scheme & scheme, const double tension)
{
  // 0 is E itself in the restored scheme; in the non-oscillatory one, tensions up to 1 would limit smooth data.
  const bool mayBeSmall = scheme.Limited == Correction::TowardsLinear;
  if (!std::isfinite(tension) || !(mayBeSmall ? tension >= 0 : tension > 1))
  {
    throw std::invalid_argument(std::string("the tension of the scheme \"") + scheme.Name + "\" must be finite and " +
                                (mayBeSmall ? "at least 0" : "greater than 1"));
  }
}

} // namespace Subdivision
} // namespace itk
