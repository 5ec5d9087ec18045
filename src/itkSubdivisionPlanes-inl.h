// SPDX-License-Identifier: Apache-2.0

// The steps of a sweep: a plane in, the children of a row out. No include guard: every target includes this file once,
// into its own namespace.

#include "itkSubdivisionThresholds-inl.h"

namespace itk
{
namespace SUBDIVISION_TARGET
{

/** The mask for the values. */
template <typename T>
SUBDIVISION_INLINE const SharedMask<2> &
                         MaskOfValues(const SubdivisionSweep<T> & s)
{
  using Scheme = NonOscillatorySubdivisionImageFilterEnums::Scheme;
  return s.Scheme == Scheme::Linear || s.Scheme == Scheme::BoundedLinear ? LinearMask : BSplineMask;
}

/** Rows of a plane around one of them; \c rowOfPlane gives a row by its index. */
template <int VRadius, typename T, typename TRow>
SUBDIVISION_INLINE AcrossRows<T, VRadius>
                   RowsAroundRow(const TRow & rowOfPlane, const std::ptrdiff_t row)
{
  AcrossRows<T, VRadius> rows;
  for (int i = 0; i <= 2 * VRadius; ++i)
  {
    rows.Row[i] = rowOfPlane(row + VRadius - i);
  }
  return rows;
}

/** How far beyond the tile the pass along the lanes needs its values, and the second differences along the lanes. */
SUBDIVISION_INLINE std::ptrdiff_t
                   ReachOfField(const int laneAxis)
{
  return laneAxis == LaneAxis ? SecondDifferenceReach : ValueReach;
}

/** Children across rows of limited fields, of the rows whose stencils the rows from \c begin to \c end complete.
 * \c field gives a row of a field by its axes in the plane and its index; \c children, a plane for either child of the
 * fields without or with the lane axis. Without a row axis, the fields themselves. */
template <bool VRowAxis, typename T, typename TField, typename TChildren>
SUBDIVISION_INLINE void
FilterFields(const SubdivisionSweep<T> & s,
             const std::ptrdiff_t        begin,
             const std::ptrdiff_t        end,
             const TField &              field,
             const TChildren &           children)
{
  for (const int laneAxis : { NoAxisInPlane, LaneAxis })
  {
    const auto values = [&](const std::ptrdiff_t r) { return field(laneAxis, r); };
    const auto secondDifferences = [&](const std::ptrdiff_t r) { return field(laneAxis | RowAxis, r); };
    if constexpr (!VRowAxis)
    {
      CopyRow(values(0), ReachOfField(laneAxis), s.Width, children(0, laneAxis));
    }
    else
    {
      for (std::ptrdiff_t r = std::max<std::ptrdiff_t>(begin - SumReach, 0); r < end - SumReach; ++r)
      {
        const std::ptrdiff_t here = r * s.Pitch;
        FilterRow<T>(RowsAroundRow<3, T>(values, r),
                     RowsAroundRow<2, T>(secondDifferences, r),
                     BSplineMask,
                     ReachOfField(laneAxis),
                     s.Width,
                     ChildrenAcrossRows<T>{ children(0, laneAxis) + here, children(1, laneAxis) + here });
      }
    }
  }
}

/** Calls \c limit for some rows and then \c filter for the same ones, until all are done: either step finds in the
 * cache what it keeps from row to row. */
template <typename T, typename TLimit, typename TFilter>
SUBDIVISION_INLINE void
LimitAndFilter(const std::ptrdiff_t first, const std::ptrdiff_t end, const TLimit & limit, const TFilter & filter)
{
  constexpr std::ptrdiff_t rowsPerStep = SubdivisionSweep<T>::RowsPerStep;
  for (std::ptrdiff_t begin = first; begin < end; begin += rowsPerStep)
  {
    const std::ptrdiff_t stepEnd = std::min(begin + rowsPerStep, end);
    for (std::ptrdiff_t r = begin; r < stepEnd; ++r)
    {
      limit(r);
    }
    filter(begin, stepEnd);
  }
}

/** The flat fields: their children within the plane. */
template <bool VRowAxis, typename T>
void
AdvanceFlatFields(SubdivisionSweep<T> & s)
{
  // The plane that is the outermost one for children whose thresholds are just complete.
  const T * const plane = s.HasSweepAxis ? s.Input[2] : s.Input[0];
  const auto      limit = [&](const std::ptrdiff_t r) SUBDIVISION_ATTRIBUTE { LimitFlatFields<VRowAxis>(s, plane, r); };
  const auto      filter = [&](const std::ptrdiff_t begin, const std::ptrdiff_t end) SUBDIVISION_ATTRIBUTE {
    const auto field = [&](const int axes, const std::ptrdiff_t r) {
      return axes == NoAxisInPlane ? plane + r * s.Pitch : LimitedRow(s, 0, axes, r);
    };
    const auto children = [&](const int child, const int laneAxis) { return s.FlatChildren[child][laneAxis][0]; };
    FilterFields<VRowAxis>(s, begin, end, field, children);
  };
  // The first row is there for the differences between it and the next one only.
  LimitAndFilter<T>(VRowAxis ? -SumReach - 1 : 0, VRowAxis ? s.Height + SumReach : 1, limit, filter);
}

/** The steep fields of two planes: their children within the plane. */
template <bool VRowAxis, typename T>
void
AdvanceSteepFields(SubdivisionSweep<T> & s, const bool areWindowsComplete)
{
  for (auto & childrenAcrossRows : s.SteepChildren)
  {
    for (auto & children : childrenAcrossRows)
    {
      children.Rotate();
      children.Rotate();
    }
  }
  const auto limit = [&](const std::ptrdiff_t r) SUBDIVISION_ATTRIBUTE {
    AdvanceSlopes(s, VRowAxis ? r + 1 : r);
    LimitSteepFields<VRowAxis>(s, r);
  };
  const auto filter = [&](const std::ptrdiff_t begin, const std::ptrdiff_t end) SUBDIVISION_ATTRIBUTE {
    for (int plane = 0; plane < 2 && areWindowsComplete; ++plane)
    {
      const auto field = [&](const int axes, const std::ptrdiff_t r) { return LimitedRow(s, plane, axes, r); };
      const auto children = [&](const int child, const int laneAxis) {
        return s.SteepChildren[child][laneAxis][1 - plane];
      };
      FilterFields<VRowAxis>(s, begin, end, field, children);
    }
  };
  if constexpr (VRowAxis)
  {
    AdvanceSlopes(s, -SumReach - 1);
  }
  LimitAndFilter<T>(VRowAxis ? -SumReach - 1 : 0, VRowAxis ? s.Height + SumReach : 1, limit, filter);
  for (auto & window : s.SteepWindows)
  {
    window.Pair.Rotate();
    window.Later.Rotate();
  }
}

/** Smallest and largest of the neighbours in the plane of every voxel. */
template <typename T>
void
AdvanceNeighbours(SubdivisionSweep<T> & s)
{
  auto & buffers = s.Rows;
  s.SmallestNeighbour.Rotate();
  s.LargestNeighbour.Rotate();
  if (!s.HasRowAxis)
  {
    const AlongLanes<T> values{ s.Input[0] };
    FindExtrema(values, values, s.Width, s.SmallestNeighbour[0], s.LargestNeighbour[0]);
    return;
  }
  for (std::ptrdiff_t r = -1; r < s.Height + 1; ++r)
  {
    buffers.Smallest.Rotate();
    buffers.Largest.Rotate();
    const AlongLanes<T> values{ s.Input[0] + r * s.Pitch };
    FindExtrema(values, values, s.Width, buffers.Smallest[0], buffers.Largest[0]);
    if (r - 1 >= 0)
    {
      const std::ptrdiff_t back = (r - 1) * s.Pitch;
      FindExtrema(RowsAround<1>(buffers.Smallest, 0, 0),
                  RowsAround<1>(buffers.Largest, 0, 0),
                  s.Width,
                  s.SmallestNeighbour[0] + back,
                  s.LargestNeighbour[0] + back);
    }
  }
}

/** Children across rows of the values alone. */
template <typename T>
void
AdvanceValues(SubdivisionSweep<T> & s)
{
  const auto values = [&](const std::ptrdiff_t r) { return s.Input[0] + r * s.Pitch; };
  if (!s.HasRowAxis)
  {
    CopyRow(values(0), ValueReach, s.Width, s.FlatChildren[0][0][0]);
    return;
  }
  for (std::ptrdiff_t r = 0; r < s.Height; ++r)
  {
    const std::ptrdiff_t here = r * s.Pitch;
    FilterRow<T>(RowsAroundRow<3, T>(values, r),
                 NoSecondDifferences{},
                 MaskOfValues(s),
                 ValueReach,
                 s.Width,
                 ChildrenAcrossRows<T>{ s.FlatChildren[0][0][0] + here, s.FlatChildren[1][0][0] + here });
  }
}

/** The step of a sweep that takes the newest input plane. */
template <typename T>
void
AdvancePlane(SubdivisionSweep<T> & s)
{
  using Scheme = NonOscillatorySubdivisionImageFilterEnums::Scheme;
  ++s.Planes;
  for (auto & childrenAcrossRows : s.FlatChildren)
  {
    for (auto & children : childrenAcrossRows)
    {
      children.Rotate();
    }
  }
  if (s.Scheme == Scheme::NonOscillatory)
  {
    // The first planes only fill the rings; what would be computed from them is not used.
    constexpr std::ptrdiff_t flatFrom = SubdivisionMasks::ThresholdedRadius;
    constexpr std::ptrdiff_t steepFrom = flatFrom + SubdivisionMasks::WindowRadius;
    if (!s.HasSweepAxis || s.Planes >= flatFrom)
    {
      s.HasRowAxis ? AdvanceFlatFields<true>(s) : AdvanceFlatFields<false>(s);
    }
    if (s.HasSweepAxis && s.IsPairComplete())
    {
      const bool areWindowsComplete = s.Planes >= steepFrom;
      s.HasRowAxis ? AdvanceSteepFields<true>(s, areWindowsComplete) : AdvanceSteepFields<false>(s, areWindowsComplete);
    }
  }
  else
  {
    AdvanceValues(s);
    if (s.Scheme == Scheme::BoundedLinear)
    {
      AdvanceNeighbours(s);
    }
  }
}

/** Smallest and largest neighbour of the voxels of a row. */
template <typename T>
SUBDIVISION_INLINE void
FindBounds(const SubdivisionSweep<T> & s, const std::ptrdiff_t offset, const int age)
{
  if (s.HasSweepAxis)
  {
    FindExtrema(RowsAround<1>(s.SmallestNeighbour, age + 2, offset),
                RowsAround<1>(s.LargestNeighbour, age + 2, offset),
                s.Width,
                s.SmallestOfRow[age],
                s.LargestOfRow[age]);
  }
  else
  {
    CopyRow(s.SmallestNeighbour[age] + offset, 0, s.Width, s.SmallestOfRow[age]);
    CopyRow(s.LargestNeighbour[age] + offset, 0, s.Width, s.LargestOfRow[age]);
  }
}

/** Clamps the children of a row to the smallest and largest neighbour of their parents; those that are not finite stay
 * as they are. */
template <typename T>
SUBDIVISION_INLINE void
BoundChildren(const SubdivisionSweep<T> & s, const int age)
{
  for (std::ptrdiff_t x = 0; x < s.Width; x += LaneCount<T>())
  {
    const auto low = Load(s.SmallestOfRow[age] + x);
    const auto high = Load(s.LargestOfRow[age] + x);
    for (int child = 0; child < 2; ++child)
    {
      T * const  values = s.Children + 2 * x + child * LaneCount<T>();
      const auto value = Load(values);
      Store(IfFinite(value, OrderedMin(OrderedMax(value, low), high)), values);
    }
  }
}

/** Of one row of children across rows, the children across planes, in the planes that were completed last. */
template <typename T>
void
ComputeRow(const SubdivisionSweep<T> & s, const std::ptrdiff_t row, const int rowChild, const int planes)
{
  using Scheme = NonOscillatorySubdivisionImageFilterEnums::Scheme;
  const std::ptrdiff_t offset = row * s.Pitch;
  const bool           isThresholded = s.Scheme == Scheme::NonOscillatory;
  // One field after the other, since the planes share most of what they read of it.
  for (int laneAxis = NoAxisInPlane; laneAxis <= (isThresholded ? LaneAxis : NoAxisInPlane); ++laneAxis)
  {
    const auto & flat = s.FlatChildren[rowChild][laneAxis];
    const auto & steep = s.SteepChildren[rowChild][laneAxis];
    const auto   reach = ReachOfField(laneAxis);
    for (int age = planes - 1; age >= 0; --age)
    {
      const ChildrenAcrossRows<T> children{ s.SweepChildren[age][0][laneAxis], s.SweepChildren[age][1][laneAxis] };
      if (!s.HasSweepAxis)
      {
        CopyRow(flat[age] + offset, reach, s.Width, children.Before);
      }
      else if (isThresholded)
      {
        FilterRow<T>(
          RowsAround<3>(flat, age, offset), RowsAround<2>(steep, age, offset), BSplineMask, reach, s.Width, children);
      }
      else
      {
        FilterRow<T>(
          RowsAround<3>(flat, age, offset), NoSecondDifferences{}, MaskOfValues(s), reach, s.Width, children);
      }
    }
  }
  if (s.Scheme == Scheme::BoundedLinear)
  {
    for (int age = 0; age < planes; ++age)
    {
      FindBounds(s, offset, age);
    }
  }
}

/** Of one row of children across planes, the children along the lanes. */
template <typename T>
void
ComputeChildren(const SubdivisionSweep<T> & s, const int age, const int sweepChild)
{
  using Scheme = NonOscillatorySubdivisionImageFilterEnums::Scheme;
  const auto &                row = s.SweepChildren[age][sweepChild];
  const AlongLanes<T>         values{ row[NoAxisInPlane] };
  const ChildrenAlongLanes<T> children{ s.Children };
  if (s.Scheme == Scheme::NonOscillatory)
  {
    FilterRow<T>(values, AlongLanes<T>{ row[LaneAxis] }, BSplineMask, 0, s.Width, children);
  }
  else
  {
    FilterRow<T>(values, NoSecondDifferences{}, MaskOfValues(s), 0, s.Width, children);
  }
  if (s.Scheme == Scheme::BoundedLinear)
  {
    BoundChildren(s, age);
  }
}

} // namespace SUBDIVISION_TARGET
} // namespace itk
