// SPDX-License-Identifier: Apache-2.0
#ifndef SubdivisionPhantom_h
#define SubdivisionPhantom_h

#include <algorithm>
#include <array>
#include <cmath>

/** The phantom of docs/scheme.md: bodies of value 1 on a ground of 0, in 96³ voxels. Indices are x, y, z. */
namespace SubdivisionPhantom
{
using Point = std::array<double, 3>;

constexpr long   Size = 96;
constexpr Point  SolidCentre{ 26, 26, 66 };
constexpr double SolidRadius = 16.0;
constexpr Point  RampCentre{ 66, 66, 66 };
constexpr double RampRadius = 20.0;

inline double
Distance(const Point & a, const Point & b)
{
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

/** Whether a point lies in a box, half open. */
inline bool
InBox(const Point & p, const Point & lower, const Point & upper)
{
  for (int w = 0; w < 3; ++w)
  {
    if (p[w] < lower[w] || p[w] >= upper[w])
    {
      return false;
    }
  }
  return true;
}

inline double
ValueAt(const Point & p)
{
  const bool cube = InBox(p, { 8, 8, 8 }, { 28, 28, 28 });
  const bool stick = InBox(p, { 6, 8, 40 }, { 46, 10, 42 });
  const bool plane = InBox(p, { 50, 50, 8 }, { 86, 52, 40 });
  const bool attachedPlane = InBox(p, { 50, 50, 8 }, { 86, 80, 10 });
  const bool solidSphere = Distance(p, SolidCentre) <= SolidRadius;
  if (cube || stick || plane || attachedPlane || solidSphere)
  {
    return 1.0;
  }
  return std::max(0.0, 1.0 - Distance(p, RampCentre) / RampRadius);
}

/** Well inside a sphere: more than 6 voxels from its surface, and for the ramp more than 8 from its centre, where the
 * slope has a jump. There the data is smooth to every stencil. */
inline bool
IsSmoothAround(const Point & p)
{
  const double fromRamp = Distance(p, RampCentre);
  return Distance(p, SolidCentre) < SolidRadius - 6.0 || (fromRamp < RampRadius - 6.0 && fromRamp > 8.0);
}

} // namespace SubdivisionPhantom

#endif
