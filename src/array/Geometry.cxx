// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/Geometry.h"

#include "NonOscillatorySubdivision/Scheme.h"
#include "array/CheckedArithmetic.h"

namespace itk
{
namespace Subdivision
{
namespace
{

constexpr bool
IsUpperChild(const std::int64_t child)
{
  return child % Children != 0;
}

/** The voxel whose child this is: half of the index, rounded down. */
constexpr std::int64_t
GetParent(const std::int64_t child)
{
  return child / Children - (child < 0 && IsUpperChild(child) ? 1 : 0);
}

std::int64_t
GetLowerChild(const std::int64_t parent)
{
  return CheckedAdd(parent, parent);
}

/** The last index, as long as there is one. */
std::int64_t
FindLast(const Interval & interval)
{
  if (interval.Size == 0)
  {
    throw std::invalid_argument("an interval of indices is empty");
  }
  return GetLast(interval);
}

} // namespace

Interval
GetChildren(const Interval & parents)
{
  const std::int64_t lastParent = FindLast(parents);
  return MakeInterval(GetLowerChild(parents.First), CheckedAdd(GetLowerChild(lastParent), 1));
}

Interval
GetParents(const Interval & children)
{
  const std::int64_t last = FindLast(children);
  return MakeInterval(GetParent(children.First), GetParent(last));
}

Interval
GetStencil(const Interval & children, const int radius)
{
  const std::int64_t lastChild = FindLast(children);
  const std::int64_t first = CheckedSubtract(GetParent(children.First), radius);
  const std::int64_t last = CheckedAdd(GetParent(lastChild), radius);
  return MakeInterval(first + (IsUpperChild(children.First) ? 1 : 0), last - (IsUpperChild(lastChild) ? 0 : 1));
}

} // namespace Subdivision
} // namespace itk
