// SPDX-License-Identifier: Apache-2.0

// The steps of a sweep: a plane in, the children of a row out. No include guard: every target includes this file once,
// into its own namespace.

#include "itkSubdivisionThresholds-inl.h"

namespace itk
{
namespace SUBDIVISION_TARGET
{

/** The length of a row of both children of every voxel along the lanes. */
template <typename T>
SUBDIVISION_INLINE std::ptrdiff_t
                   ChildWidth(const SubdivisionSweep<T> & s)
{
  return 2 * ((s.Width + LaneCount<T>() - 1) / LaneCount<T>() * LaneCount<T>());
}

/** The children within one of the planes that are computed together, of rows of \c field and of its limited second
 * differences; with a row axis, of the rows whose stencils these complete. */
template <bool VRowAxis, typename T, typename TField>
void
FilterFields(SubdivisionSweep<T> & s,
             const int             plane,
             const std::ptrdiff_t  begin,
             const std::ptrdiff_t  end,
             const TField &        field,
             T * const             lowerChildren,
             T * const             upperChildren)
{
  const std::ptrdiff_t width = s.Width;
  const auto filterLanes = [=](const T * const row, const T * const curvature, T * const result) SUBDIVISION_ATTRIBUTE {
    FilterRow<T>(AlongLanes<T>{ row }, AlongLanes<T>{ curvature }, BSplineMask, width, ChildrenAlongLanes<T>{ result });
  };
  if constexpr (!VRowAxis)
  {
    filterLanes(field(0), LimitedRow(s, plane, LaneAxis, 0), lowerChildren);
  }
  else
  {
    // Copies, which the compiler keeps at hand.
    auto valueRows = s.Rows.Values[plane];
    auto secondDifferenceRows = s.Rows.SecondDifferences[plane];
    for (std::ptrdiff_t r = begin; r < end; ++r)
    {
      valueRows.Rotate();
      if (HasLaneFields<VRowAxis>(s, r))
      {
        filterLanes(field(r), LimitedRow(s, plane, LaneAxis, r), valueRows[0]);
      }
      if (HasRowFields(r))
      {
        const std::ptrdiff_t back = r - SubdivisionMasks::WindowRadius;
        secondDifferenceRows.Rotate();
        filterLanes(
          LimitedRow(s, plane, RowAxis, back), LimitedRow(s, plane, BothAxesInPlane, back), secondDifferenceRows[0]);
      }
      const std::ptrdiff_t complete = r - SumReach;
      if (complete >= 0)
      {
        const std::ptrdiff_t offset = complete * s.ChildPitch;
        FilterRow<T>(RowsAround<3>(valueRows, SumReach - ValueReach, 0),
                     RowsAround<2>(secondDifferenceRows, 0, 0),
                     BSplineMask,
                     ChildWidth(s),
                     ChildrenAcrossRows<T>{ lowerChildren + offset, upperChildren + offset });
      }
    }
    s.Rows.Values[plane] = valueRows;
    s.Rows.SecondDifferences[plane] = secondDifferenceRows;
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
    const auto values = [&](const std::ptrdiff_t r) { return plane + r * s.Pitch; };
    FilterFields<VRowAxis>(s, 0, begin, end, values, s.FlatChildren[0][0], s.FlatChildren[1][0]);
  };
  // The first row is there for the differences between it and the next one only.
  LimitAndFilter<T>(VRowAxis ? -SumReach - 1 : 0, VRowAxis ? s.Height + SumReach : 1, limit, filter);
}

/** The steep fields of two planes: their children within the plane. */
template <bool VRowAxis, typename T>
void
AdvanceSteepFields(SubdivisionSweep<T> & s, const bool areWindowsComplete)
{
  for (auto & children : s.SteepChildren)
  {
    children.Rotate();
    children.Rotate();
  }
  const auto limit = [&](const std::ptrdiff_t r) SUBDIVISION_ATTRIBUTE {
    AdvanceSlopes(s, VRowAxis ? r + 1 : r);
    LimitSteepFields<VRowAxis>(s, r);
  };
  const auto filter = [&](const std::ptrdiff_t begin, const std::ptrdiff_t end) SUBDIVISION_ATTRIBUTE {
    for (int plane = 0; plane < 2 && areWindowsComplete; ++plane)
    {
      const int  age = 1 - plane;
      const auto slopes = [&](const std::ptrdiff_t r) { return LimitedRow(s, plane, NoAxisInPlane, r); };
      FilterFields<VRowAxis>(s, plane, begin, end, slopes, s.SteepChildren[0][age], s.SteepChildren[1][age]);
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

/** The children within the plane of the values alone. */
template <typename T>
void
AdvanceValues(SubdivisionSweep<T> & s, const SharedMask<2> & mask)
{
  auto &     buffers = s.Rows;
  const auto filterLanes = [&](const T * const row, T * const result) SUBDIVISION_ATTRIBUTE {
    FilterRow<T>(AlongLanes<T>{ row }, NoSecondDifferences{}, mask, s.Width, ChildrenAlongLanes<T>{ result });
  };
  if (!s.HasRowAxis)
  {
    filterLanes(s.Input[0], s.FlatChildren[0][0]);
    return;
  }
  for (std::ptrdiff_t r = -ValueReach; r < s.Height + ValueReach; ++r)
  {
    buffers.Values[0].Rotate();
    filterLanes(s.Input[0] + r * s.Pitch, buffers.Values[0][0]);
    if (r - ValueReach >= 0)
    {
      const std::ptrdiff_t back = (r - ValueReach) * s.ChildPitch;
      FilterRow<T>(RowsAround<3>(buffers.Values[0], 0, 0),
                   NoSecondDifferences{},
                   mask,
                   ChildWidth(s),
                   ChildrenAcrossRows<T>{ s.FlatChildren[0][0] + back, s.FlatChildren[1][0] + back });
    }
  }
}

/** The step of a sweep that takes the newest input plane. */
template <typename T>
void
AdvancePlane(SubdivisionSweep<T> & s)
{
  using Scheme = NonOscillatorySubdivisionImageFilterEnums::Scheme;
  ++s.Planes;
  for (auto & children : s.FlatChildren)
  {
    children.Rotate();
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
    AdvanceValues(s, s.Scheme == Scheme::BSpline ? BSplineMask : LinearMask);
    if (s.Scheme == Scheme::BoundedLinear)
    {
      AdvanceNeighbours(s);
    }
  }
}

/** Clamps the children of a row to the smallest and largest neighbour of their parents; those that are not finite stay
 * as they are. */
template <typename T>
void
BoundChildren(const SubdivisionSweep<T> & s, const std::ptrdiff_t row, const int age)
{
  const int            newest = s.HasSweepAxis ? age + 2 : age;
  const std::ptrdiff_t offset = row * s.Pitch;
  const auto           smallest = RowsAround<1>(s.SmallestNeighbour, newest, offset);
  const auto           largest = RowsAround<1>(s.LargestNeighbour, newest, offset);
  for (std::ptrdiff_t x = 0; x < s.Width; x += LaneCount<T>())
  {
    auto low = smallest(x, 1);
    auto high = largest(x, 1);
    if (s.HasSweepAxis)
    {
      low = OrderedMin(OrderedMin(low, smallest(x, 0)), smallest(x, -1));
      high = OrderedMax(OrderedMax(high, largest(x, 0)), largest(x, -1));
    }
    for (int child = 0; child < (s.HasSweepAxis ? 4 : 2); ++child)
    {
      T * const  values = s.Children[age][child / 2] + 2 * x + child % 2 * LaneCount<T>();
      const auto value = Load(values);
      Store(IfFinite(value, OrderedMin(OrderedMax(value, low), high)), values);
    }
  }
}

/** Of the planes that were completed last, one row of children within the plane, and its children along the sweep. */
template <typename T>
void
ComputeChildren(const SubdivisionSweep<T> & s, const std::ptrdiff_t row, const int rowChild, const int planes)
{
  using Scheme = NonOscillatorySubdivisionImageFilterEnums::Scheme;
  const std::ptrdiff_t childWidth = ChildWidth(s);
  // Planes share most of what they read: a strip of it stays in the first-level cache.
  constexpr std::ptrdiff_t strip = 256;
  for (std::ptrdiff_t x = 0; x < childWidth; x += strip)
  {
    const std::ptrdiff_t width = std::min(strip, childWidth - x);
    const std::ptrdiff_t offset = row * s.ChildPitch + x;
    for (int age = planes - 1; age >= 0; --age)
    {
      const ChildrenAcrossRows<T> children{ s.Children[age][0] + x, s.Children[age][1] + x };
      if (!s.HasSweepAxis)
      {
        CopyRow(s.FlatChildren[rowChild][age] + offset, width, s.Children[age][0] + x);
      }
      else if (s.Scheme == Scheme::NonOscillatory)
      {
        FilterRow<T>(RowsAround<3>(s.FlatChildren[rowChild], age, offset),
                     RowsAround<2>(s.SteepChildren[rowChild], age, offset),
                     BSplineMask,
                     width,
                     children);
      }
      else
      {
        FilterRow<T>(RowsAround<3>(s.FlatChildren[rowChild], age, offset),
                     NoSecondDifferences{},
                     s.Scheme == Scheme::BSpline ? BSplineMask : LinearMask,
                     width,
                     children);
      }
    }
  }
  for (int age = 0; age < planes && s.Scheme == Scheme::BoundedLinear; ++age)
  {
    BoundChildren(s, row, age);
  }
}

} // namespace SUBDIVISION_TARGET
} // namespace itk
