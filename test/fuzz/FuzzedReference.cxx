// SPDX-License-Identifier: Apache-2.0
#include "FuzzedReference.h"

namespace FuzzedReference
{

namespace Reference = SubdivisionReference;

Reference::Boundary<MostAxes>
MakeBoundary(const unsigned int kind, const double constant)
{
  switch (kind)
  {
    case 0:
      return Reference::ZeroFlux<MostAxes>();
    case 1:
      return Reference::Mirror<MostAxes>();
    case 2:
      return Reference::Periodic<MostAxes>();
    default:
      return Reference::Constant<MostAxes>(constant);
  }
}

double
GetChild(const Grid3 & image, Settings settings, const Index3 & index)
{
  Index3 parent{};
  Index3 child{};
  for (std::size_t axis = 0; axis < MostAxes; ++axis)
  {
    parent[axis] = settings.axes[axis] ? index[axis] / 2 : index[axis];
    child[axis] = settings.axes[axis] ? index[axis] % 2 : 0;
  }
  // The parent alone, all others are its boundary.
  const auto boundary = settings.boundary;
  settings.boundary = [&](const Grid3 &, const Index3 & offset) {
    return boundary(image, Reference::Sum<MostAxes>(parent, offset));
  };
  Index3 one;
  one.fill(1);
  return Reference::Subdivision<MostAxes>(Grid3(Index3{}, one), settings).At(child);
}

} // namespace FuzzedReference
