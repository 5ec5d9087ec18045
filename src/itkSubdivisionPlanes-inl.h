// SPDX-License-Identifier: Apache-2.0

// The steps of a sweep: a plane in, the children of a row out. No include guard: every target includes this file once,
// into its own namespace.

#include "itkSubdivisionThresholds-inl.h"

namespace itk
{
namespace SUBDIVISION_TARGET
{

/** The children within a plane of a field of values and, by [subset in plane], of its limited second differences. */
template <typename T, typename TPlanes>
void
FilterFields(SubdivisionSweep<T> & s,
             const T * const       values,
             T * const * const     secondDifferences,
             const TPlanes &       children)
{
  auto &     buffers = s.Rows;
  const auto filterLanes =
    [&](const T * const row, const T * const curvature, T * const lower, T * const upper) SUBDIVISION_ATTRIBUTE {
      FilterRow(AlongLanes<T>{ row }, AlongLanes<T>{ curvature }, BSplineMask, s.Width, lower, upper);
    };
  if (!s.HasRowAxis)
  {
    filterLanes(values, secondDifferences[LaneAxis], children[0][0], children[LaneAxis][0]);
    return;
  }
  for (std::ptrdiff_t r = -ValueReach; r < s.Height + ValueReach; ++r)
  {
    const std::ptrdiff_t here = r * s.Pitch;
    buffers.Values[0].Rotate();
    buffers.Values[1].Rotate();
    filterLanes(values + here, secondDifferences[LaneAxis] + here, buffers.Values[0][0], buffers.Values[1][0]);
    // The row before is the outermost one whose second differences count.
    const std::ptrdiff_t before = here - s.Pitch;
    buffers.SecondDifferences[0].Rotate();
    buffers.SecondDifferences[1].Rotate();
    if (r - 1 >= -SecondDifferenceReach)
    {
      filterLanes(secondDifferences[RowAxis] + before,
                  secondDifferences[BothAxesInPlane] + before,
                  buffers.SecondDifferences[0][0],
                  buffers.SecondDifferences[1][0]);
    }
    for (int lane = 0; lane < SubdivisionMasks::Children && r - ValueReach >= 0; ++lane)
    {
      const std::ptrdiff_t back = here - ValueReach * s.Pitch;
      FilterRow(RowsAround<3>(buffers.Values[lane], 0, 0),
                RowsAround<2>(buffers.SecondDifferences[lane], 0, 0),
                BSplineMask,
                s.Width,
                children[lane][0] + back,
                children[lane + RowAxis][0] + back);
    }
  }
}

/** The flat fields: their children within the plane. */
template <typename T>
void
AdvanceFlatFields(SubdivisionSweep<T> & s)
{
  // The plane that is the outermost one for children whose thresholds are just complete.
  const T * const plane = s.HasSweepAxis ? s.Input[2] : s.Input[0];
  s.HasRowAxis ? LimitFlatFields<true>(s, plane) : LimitFlatFields<false>(s, plane);
  FilterFields(s, plane, s.Limited[0], s.FlatChildren);
}

/** The steep fields of two planes: their children within the plane. */
template <typename T>
void
AdvanceSteepFields(SubdivisionSweep<T> & s, const bool areWindowsComplete)
{
  s.HasRowAxis ? LimitSteepFields<true>(s) : LimitSteepFields<false>(s);
  for (const auto & limited : s.Limited)
  {
    for (auto & children : s.SteepChildren)
    {
      children.Rotate();
    }
    if (areWindowsComplete)
    {
      FilterFields(s, limited[NoAxisInPlane], limited, s.SteepChildren);
    }
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
  auto & buffers = s.Rows;
  if (!s.HasRowAxis)
  {
    FilterRow(AlongLanes<T>{ s.Input[0] },
              NoSecondDifferences{},
              mask,
              s.Width,
              s.FlatChildren[0][0],
              s.FlatChildren[LaneAxis][0]);
    return;
  }
  for (std::ptrdiff_t r = -ValueReach; r < s.Height + ValueReach; ++r)
  {
    buffers.Values[0].Rotate();
    buffers.Values[1].Rotate();
    FilterRow(AlongLanes<T>{ s.Input[0] + r * s.Pitch },
              NoSecondDifferences{},
              mask,
              s.Width,
              buffers.Values[0][0],
              buffers.Values[1][0]);
    for (int lane = 0; lane < SubdivisionMasks::Children && r - ValueReach >= 0; ++lane)
    {
      const std::ptrdiff_t back = (r - ValueReach) * s.Pitch;
      FilterRow(RowsAround<3>(buffers.Values[lane], 0, 0),
                NoSecondDifferences{},
                mask,
                s.Width,
                s.FlatChildren[lane][0] + back,
                s.FlatChildren[lane + RowAxis][0] + back);
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
      AdvanceFlatFields(s);
    }
    if (s.HasSweepAxis && s.IsPairComplete())
    {
      AdvanceSteepFields(s, s.Planes >= steepFrom);
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
BoundChildren(const SubdivisionSweep<T> & s,
              const std::ptrdiff_t        offset,
              const int                   age,
              const int                   sweepChildren,
              const int                   planeChildren)
{
  const int  newest = s.HasSweepAxis ? age + 2 : age;
  const auto smallest = RowsAround<1>(s.SmallestNeighbour, newest, offset);
  const auto largest = RowsAround<1>(s.LargestNeighbour, newest, offset);
  for (std::ptrdiff_t x = 0; x < s.Width; x += LaneCount<T>())
  {
    auto low = smallest(x, 1);
    auto high = largest(x, 1);
    if (s.HasSweepAxis)
    {
      low = OrderedMin(OrderedMin(low, smallest(x, 0)), smallest(x, -1));
      high = OrderedMax(OrderedMax(high, largest(x, 0)), largest(x, -1));
    }
    for (int sweep = 0; sweep < sweepChildren; ++sweep)
    {
      for (int child = 0; child < planeChildren; ++child)
      {
        T * const  values = s.Children[age][sweep][child] + x;
        const auto value = Load(values);
        Store(IfFinite(value, OrderedMin(OrderedMax(value, low), high)), values);
      }
    }
  }
}

/** The children of one row, in a given number of planes: those whose stencils were complete last. */
template <typename T>
void
ComputeChildren(const SubdivisionSweep<T> & s, const std::ptrdiff_t row, const int planes)
{
  using Scheme = NonOscillatorySubdivisionImageFilterEnums::Scheme;
  const std::ptrdiff_t offset = row * s.Pitch;
  const int            planeChildren = s.HasRowAxis ? 4 : 2;
  for (int child = 0; child < planeChildren; ++child)
  {
    // One plane after the other: they share most of what they read.
    for (int age = planes - 1; age >= 0; --age)
    {
      T * const lower = s.Children[age][0][child];
      T * const upper = s.Children[age][1][child];
      if (!s.HasSweepAxis)
      {
        CopyRow(s.FlatChildren[child][age] + offset, s.Width, lower);
      }
      else if (s.Scheme == Scheme::NonOscillatory)
      {
        FilterRow(RowsAround<3>(s.FlatChildren[child], age, offset),
                  RowsAround<2>(s.SteepChildren[child], age, offset),
                  BSplineMask,
                  s.Width,
                  lower,
                  upper);
      }
      else
      {
        FilterRow(RowsAround<3>(s.FlatChildren[child], age, offset),
                  NoSecondDifferences{},
                  s.Scheme == Scheme::BSpline ? BSplineMask : LinearMask,
                  s.Width,
                  lower,
                  upper);
      }
    }
  }
  for (int age = planes - 1; age >= 0 && s.Scheme == Scheme::BoundedLinear; --age)
  {
    BoundChildren(s, offset, age, s.HasSweepAxis ? 2 : 1, planeChildren);
  }
}

} // namespace SUBDIVISION_TARGET
} // namespace itk
