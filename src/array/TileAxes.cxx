// SPDX-License-Identifier: Apache-2.0
#include "array/TileAxes.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace itk
{
namespace Subdivision
{

TileAxes::TileAxes(const Flags & subdivided)
{
  constexpr std::ptrdiff_t most = 3;
  const std::ptrdiff_t     number = std::count(subdivided.begin(), subdivided.end(), true);
  if (subdivided.empty())
  {
    throw std::invalid_argument("an array needs at least one axis");
  }
  if (number > most)
  {
    throw std::invalid_argument(std::to_string(number) + " axes are to be subdivided, but at most three can be");
  }
  const auto first = std::find(subdivided.begin(), subdivided.end(), true);
  X = number == most ? static_cast<std::size_t>(first - subdivided.begin()) : 0;
  for (std::size_t axis = X + 1; axis < subdivided.size(); ++axis)
  {
    if (subdivided[axis])
    {
      Y = Z;
      Z = axis;
    }
  }
}

} // namespace Subdivision
} // namespace itk
