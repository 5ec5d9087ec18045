// SPDX-License-Identifier: Apache-2.0

// The steps of a sweep: a plane in, the children of a row out. No include guard: every target includes this file once,
// into its own namespace.

#include "itkSubdivisionRows-inl.h"
#include "itkSubdivisionSweep.h"

namespace itk
{
namespace SUBDIVISION_TARGET
{

// How far beyond the tile each kind of row reaches.
constexpr std::ptrdiff_t ValueReach = SubdivisionMasks::ValueRadius;
constexpr std::ptrdiff_t SecondDifferenceReach = SubdivisionMasks::SecondDifferenceRadius;
constexpr std::ptrdiff_t SumReach = SecondDifferenceReach + SubdivisionMasks::WindowRadius;

/** Rows of a plane ring, or entries of a row ring, around the one of age VRadius + newest. */
template <int VRadius, typename T, int VLength>
SUBDIVISION_INLINE AcrossRows<T, VRadius>
                   RowsAround(const SubdivisionRing<T, VLength> & ring, const int newest, const std::ptrdiff_t offset)
{
  AcrossRows<T, VRadius> rows;
  for (int i = 0; i <= 2 * VRadius; ++i)
  {
    rows.Row[i] = ring[newest + i] + offset;
  }
  return rows;
}

/** Three consecutive rows of a plane. */
template <typename T>
SUBDIVISION_INLINE AcrossRows<T, 1>
                   RowsOfPlane(const T * const row, const std::ptrdiff_t pitch)
{
  return AcrossRows<T, 1>{ { row + pitch, row, row - pitch } };
}

/** Block sums of the absolute differences of a row, for every subset of the axes in the plane.
 *
 * Differences towards the next row are kept for the call with that row. Steep sums are those of a row of slopes, added
 * to those of the same row of the slopes before, which \c previous holds and is given the new ones. */
template <bool VSteep, bool VRowAxis, typename T>
SUBDIVISION_INLINE void
SumDifferencesOfRow(const T * const                                  row,
                    const T * const                                  nextRow,
                    const typename SubdivisionSweep<T>::RowBuffers & rows,
                    T * const *                                      previous,
                    const std::ptrdiff_t                             offset,
                    const std::ptrdiff_t                             width)
{
  const auto store = [&](const auto sum, const int subset, const std::ptrdiff_t x) SUBDIVISION_ATTRIBUTE {
    if constexpr (VSteep)
    {
      T * const before = previous[subset] + offset + x;
      Store(Add(sum, Load(before)), rows.Sums[subset] + x);
      Store(sum, before);
    }
    else
    {
      Store(sum, rows.Sums[subset] + x);
    }
  };

  for (std::ptrdiff_t x = -SumReach; x < width + SumReach; x += LaneCount<T>())
  {
    const auto before = Hold(Load(row + x - 1));
    const auto value = Hold(Load(row + x));
    const auto after = Hold(Load(row + x + 1));
    store(Add(Abs(Sub(value, before)), Abs(Sub(after, value))), LaneAxis, x);
    if constexpr (VSteep)
    {
      store(Abs(value), NoAxisInPlane, x);
    }
    if constexpr (VRowAxis)
    {
      const auto difference = Sub(Load(nextRow + x), value);
      const auto differenceBefore = Sub(Load(nextRow + x - 1), before);
      const auto differenceAfter = Sub(Load(nextRow + x + 1), after);
      const auto size = Abs(difference);
      const auto sum = Add(Abs(Sub(difference, differenceBefore)), Abs(Sub(differenceAfter, difference)));
      store(Add(size, Load(rows.RowDifference + x)), RowAxis, x);
      store(Add(sum, Load(rows.RowDifferenceSum + x)), BothAxesInPlane, x);
      Store(size, rows.RowDifference + x);
      Store(sum, rows.RowDifferenceSum + x);
    }
  }
}

/** What the sweeps through the rows of a plane have in common, for the flat and for the steep fields: children along
 * the lanes as soon as the fields of a row are there, children across rows as soon as the rows around them are. */
template <typename T>
struct ThresholdedRows
{
  SubdivisionSweep<T> &                      S;
  typename SubdivisionSweep<T>::RowBuffers & Buffers;

  // Fields reach this far to either side of the tile.
  const std::ptrdiff_t Begin = -ValueReach;
  const std::ptrdiff_t End = S.Width + ValueReach;

  explicit SUBDIVISION_INLINE
  ThresholdedRows(SubdivisionSweep<T> & sweep)
    : S(sweep)
    , Buffers(sweep.Rows)
  {}

  SUBDIVISION_INLINE std::ptrdiff_t
                     FirstRow() const
  {
    return S.HasRowAxis ? -SumReach : 0;
  }

  SUBDIVISION_INLINE std::ptrdiff_t
                     EndRow() const
  {
    return S.HasRowAxis ? S.Height + SumReach : 1;
  }

  /** Block sums of a row, and what the fields with the row axis keep of them. */
  template <bool VSteep>
  SUBDIVISION_INLINE void
  SumRow(const T * const row, const T * const nextRow, const std::ptrdiff_t offset)
  {
    if (S.HasRowAxis)
    {
      Buffers.RowAxisSums.Rotate();
      Buffers.Sums[RowAxis] = Buffers.RowAxisSums[0];
      SumDifferencesOfRow<VSteep, true>(row, nextRow, Buffers, S.SlopeSums, offset, S.Width);
      Buffers.BothAxesSums.Rotate();
      WindowMinimumRow(AlongLanes<T>{ Buffers.Sums[BothAxesInPlane] }, Begin, End, Buffers.BothAxesSums[0]);
    }
    else
    {
      SumDifferencesOfRow<VSteep, false>(row, nextRow, Buffers, S.SlopeSums, offset, S.Width);
    }
  }

  SUBDIVISION_INLINE void
  FilterLanes(const T * const values, const T * const secondDifferences, T * const lower, T * const upper) const
  {
    FilterRow(AlongLanes<T>{ values }, AlongLanes<T>{ secondDifferences }, BSplineMask, 0, S.Width, lower, upper);
  }

  /** Children along the lanes of the fields without the row axis. */
  template <typename TPlanes>
  SUBDIVISION_INLINE void
  FilterValues(const T * const values, const T * const secondDifferences, const TPlanes & children)
  {
    if (S.HasRowAxis)
    {
      Buffers.Values[0].Rotate();
      Buffers.Values[1].Rotate();
      FilterLanes(values, secondDifferences, Buffers.Values[0][0], Buffers.Values[1][0]);
    }
    else
    {
      FilterLanes(values, secondDifferences, children[0][0], children[1][0]);
    }
  }

  /** The fields with the row axis, from the second differences of three rows around the one they belong to and from the
   * sums around it; and their children along the lanes. */
  template <typename TRowSums, typename TBothSums>
  SUBDIVISION_INLINE void
  FilterSecondDifferences(const AcrossRows<T, 1> & rowsAround, const TRowSums & rowSums, const TBothSums & bothSums)
  {
    SecondDifferenceRow(rowsAround, Begin - 1, End + 1, Buffers.RowCurvature);
    LimitRow(RowValues<T>{ Buffers.RowCurvature }, rowSums, S.Tension, Begin, End, Buffers.Limited[RowAxis]);
    LimitRow(
      RowCurvature<T>{ Buffers.RowCurvature }, bothSums, S.Tension, Begin, End, Buffers.Limited[BothAxesInPlane]);
    Buffers.SecondDifferences[0].Rotate();
    Buffers.SecondDifferences[1].Rotate();
    FilterLanes(Buffers.Limited[RowAxis],
                Buffers.Limited[BothAxesInPlane],
                Buffers.SecondDifferences[0][0],
                Buffers.SecondDifferences[1][0]);
  }

  /** Children across rows of the row whose stencil the newest sums, those of row \c newest, complete. */
  template <typename TPlanes>
  SUBDIVISION_INLINE void
  FilterAcrossRows(const std::ptrdiff_t newest, const TPlanes & children)
  {
    const std::ptrdiff_t row = newest - SumReach;
    for (int lane = 0; lane < SubdivisionMasks::Children && row >= 0; ++lane)
    {
      FilterRow(RowsAround<3>(Buffers.Values[lane], 1, 0),
                RowsAround<2>(Buffers.SecondDifferences[lane], 0, 0),
                BSplineMask,
                0,
                S.Width,
                children[lane][0] + row * S.Pitch,
                children[lane + RowAxis][0] + row * S.Pitch);
    }
  }
};

/** The flat fields: their children within the plane. */
template <typename T>
void
AdvanceFlatFields(SubdivisionSweep<T> & s)
{
  ThresholdedRows<T> rows(s);
  // The plane that is the outermost one for children whose thresholds are just complete.
  const T * const plane = s.HasSweepAxis ? s.Input[2] : s.Input[0];

  if (s.HasRowAxis)
  {
    // Only for the differences towards the first row.
    const T * const row = plane + (rows.FirstRow() - 1) * s.Pitch;
    rows.template SumRow<false>(row, row + s.Pitch, 0);
  }
  for (std::ptrdiff_t r = rows.FirstRow(); r < rows.EndRow(); ++r)
  {
    const T * const row = plane + r * s.Pitch;
    rows.template SumRow<false>(row, row + s.Pitch, 0);
    LimitRow(RowCurvature<T>{ row },
             AlongLanes<T>{ s.Rows.Sums[LaneAxis] },
             s.Tension,
             rows.Begin,
             rows.End,
             s.Rows.Limited[LaneAxis]);
    rows.FilterValues(row, s.Rows.Limited[LaneAxis], s.FlatChildren);
    if (s.HasRowAxis && r - 2 >= -SecondDifferenceReach)
    {
      rows.FilterSecondDifferences(RowsOfPlane(row - 2 * s.Pitch, s.Pitch),
                                   RowsAround<2>(s.Rows.RowAxisSums, 0, 0),
                                   RowsAround<2>(s.Rows.BothAxesSums, 0, 0));
    }
    if (s.HasRowAxis)
    {
      rows.FilterAcrossRows(r, s.FlatChildren);
    }
  }
}

/** The next row of slopes, that is, differences between the two newest input planes. */
template <typename T>
SUBDIVISION_INLINE void
AdvanceSlope(SubdivisionSweep<T> & s, const std::ptrdiff_t row)
{
  s.Rows.Slope.Rotate();
  const T * const newest = s.Input[0] + row * s.Pitch;
  const T * const before = s.Input[1] + row * s.Pitch;
  T * const       slope = s.Rows.Slope[0];
  for (std::ptrdiff_t x = -SumReach - 1; x < s.Width + SumReach + 1; x += LaneCount<T>())
  {
    Store(Sub(Load(newest + x), Load(before + x)), slope + x);
  }
}

/** The window minima within the plane of one row's steep sums: of the subsets without the row axis for this row, of the
 * others for the row two back. */
template <typename T>
SUBDIVISION_INLINE void
AdvanceSteepMinima(SubdivisionSweep<T> & s, const ThresholdedRows<T> & rows, const std::ptrdiff_t r)
{
  const std::ptrdiff_t here = r * s.Pitch;
  WindowMinimumRow(AlongLanes<T>{ s.Rows.Sums[LaneAxis] }, rows.Begin, rows.End, s.SteepMinima[LaneAxis][0] + here);
  if (s.HasRowAxis && r - 2 >= -SecondDifferenceReach)
  {
    const std::ptrdiff_t back = (r - 2) * s.Pitch;
    WindowMinimumRow(RowsAround<2>(s.Rows.RowAxisSums, 0, 0), rows.Begin, rows.End, s.SteepMinima[RowAxis][0] + back);
    WindowMinimumRow(
      RowsAround<2>(s.Rows.BothAxesSums, 0, 0), rows.Begin, rows.End, s.SteepMinima[BothAxesInPlane][0] + back);
  }
}

/** The steep fields: the window minima of the newest slopes, and, of the plane whose window they complete, the children
 * within the plane. */
template <typename T>
void
AdvanceSteepFields(SubdivisionSweep<T> & s, const bool isWindowComplete)
{
  ThresholdedRows<T> rows(s);
  auto &             buffers = s.Rows;
  for (auto & minima : s.SteepMinima)
  {
    minima.Rotate();
  }
  if (s.HasRowAxis)
  {
    // Only for the differences towards the first row.
    AdvanceSlope(s, rows.FirstRow() - 1);
    AdvanceSlope(s, rows.FirstRow());
    buffers.Sums[NoAxisInPlane] = buffers.Limited[NoAxisInPlane];
    rows.template SumRow<true>(buffers.Slope[1], buffers.Slope[0], (rows.FirstRow() - 1) * s.Pitch);
  }
  for (std::ptrdiff_t r = rows.FirstRow(); r < rows.EndRow(); ++r)
  {
    const std::ptrdiff_t here = r * s.Pitch;
    AdvanceSlope(s, s.HasRowAxis ? r + 1 : r);
    // The sums of the slopes themselves have no window within the plane.
    buffers.Sums[NoAxisInPlane] = s.SteepMinima[NoAxisInPlane][0] + here;
    rows.template SumRow<true>(buffers.Slope[s.HasRowAxis ? 1 : 0], buffers.Slope[0], here);
    AdvanceSteepMinima(s, rows, r);
    if (!isWindowComplete)
    {
      continue;
    }

    buffers.SweepCurvature.Rotate();
    const T * const curvature = buffers.SweepCurvature[0];
    SecondDifferenceRow(RowsAround<1>(s.Input, 2, here), rows.Begin - 1, rows.End + 1, buffers.SweepCurvature[0]);
    LimitRow(RowValues<T>{ curvature },
             RowsAround<2>(s.SteepMinima[NoAxisInPlane], 0, here),
             s.Tension,
             rows.Begin,
             rows.End,
             buffers.Limited[NoAxisInPlane]);
    LimitRow(RowCurvature<T>{ curvature },
             RowsAround<2>(s.SteepMinima[LaneAxis], 0, here),
             s.Tension,
             rows.Begin,
             rows.End,
             buffers.Limited[LaneAxis]);
    rows.FilterValues(buffers.Limited[NoAxisInPlane], buffers.Limited[LaneAxis], s.SteepChildren);
    if (s.HasRowAxis && r - 2 >= -SecondDifferenceReach)
    {
      const std::ptrdiff_t back = (r - 2) * s.Pitch;
      rows.FilterSecondDifferences(RowsAround<1>(buffers.SweepCurvature, 1, 0),
                                   RowsAround<2>(s.SteepMinima[RowAxis], 0, back),
                                   RowsAround<2>(s.SteepMinima[BothAxesInPlane], 0, back));
    }
    if (s.HasRowAxis)
    {
      rows.FilterAcrossRows(r, s.SteepChildren);
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
              0,
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
              0,
              s.Width,
              buffers.Values[0][0],
              buffers.Values[1][0]);
    for (int lane = 0; lane < SubdivisionMasks::Children && r - ValueReach >= 0; ++lane)
    {
      const std::ptrdiff_t back = (r - ValueReach) * s.Pitch;
      FilterRow(RowsAround<3>(buffers.Values[lane], 0, 0),
                NoSecondDifferences{},
                mask,
                0,
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
  for (int child = 0; child < SubsetsInPlane; ++child)
  {
    s.FlatChildren[child].Rotate();
    s.SteepChildren[child].Rotate();
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
    if (s.HasSweepAxis && s.Planes > 1)
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
                  0,
                  s.Width,
                  lower,
                  upper);
      }
      else
      {
        FilterRow(RowsAround<3>(s.FlatChildren[child], age, offset),
                  NoSecondDifferences{},
                  s.Scheme == Scheme::BSpline ? BSplineMask : LinearMask,
                  0,
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
