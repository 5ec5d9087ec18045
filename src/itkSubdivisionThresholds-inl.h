// SPDX-License-Identifier: Apache-2.0

// The fields of second differences, limited by their thresholds (docs/scheme.md, section 3), plane by plane. No include
// guard: every target includes this file once, into its own namespace.

#include "itkSubdivisionRows-inl.h"
#include "itkSubdivisionSweep.h"

#include <algorithm>

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

/** The sizes of the differences that a row and the one after it add to the block sums of the row's voxels: of those
 * along the lanes, of those between the rows, and of those along both axes. */
template <bool VRowAxis, typename T, typename TVector>
SUBDIVISION_INLINE void
SumDifferences(const T * const      row,
               const T * const      nextRow,
               const std::ptrdiff_t x,
               TVector &            lanes,
               TVector &            rows,
               TVector &            both)
{
  const auto before = Hold(Load(row + x - 1));
  const auto value = Hold(Load(row + x));
  const auto after = Hold(Load(row + x + 1));
  lanes = Add(Magnitude(Sub(value, before)), Magnitude(Sub(after, value)));
  if constexpr (VRowAxis)
  {
    const auto difference = Sub(Load(nextRow + x), value);
    const auto differenceBefore = Sub(Load(nextRow + x - 1), before);
    const auto differenceAfter = Sub(Load(nextRow + x + 1), after);
    rows = Magnitude(difference);
    both = Add(Magnitude(Sub(difference, differenceBefore)), Magnitude(Sub(differenceAfter, difference)));
  }
}

/** Adds what a neighbour left, and leaves the part of the sum that came in. */
template <typename T, typename TVector>
SUBDIVISION_INLINE TVector
AddKept(const TVector part, T * const kept)
{
  const auto sum = Add(Load(kept), part);
  Store(part, kept);
  return sum;
}

/** Block sums of the flat fields of a row. */
template <bool VRowAxis, typename T>
SUBDIVISION_INLINE void
SumFlatDifferences(const typename SubdivisionSweep<T>::RowBuffers & buffers,
                   const T * const                                  row,
                   const T * const                                  nextRow,
                   const std::ptrdiff_t                             width)
{
  // Copies, since stores of vectors might change what is in memory.
  T * const laneSums = buffers.LaneSums[0];
  T * const rowSums = buffers.RowSums[0][0];
  T * const bothSums = buffers.BothSums[0];
  T * const keptRowSums = buffers.KeptRowSums[0];
  T * const keptBothSums = buffers.KeptBothSums[0];
  for (std::ptrdiff_t x = FirstVector<T>(SumReach); x < width + SumReach; x += LaneCount<T>())
  {
    Vector<T> lanes;
    Vector<T> rows;
    Vector<T> both;
    SumDifferences<VRowAxis>(row, nextRow, x, lanes, rows, both);
    Store(Comparable(lanes), laneSums + x);
    if constexpr (VRowAxis)
    {
      Store(Comparable(AddKept(rows, keptRowSums + x)), rowSums + x);
      Store(Comparable(AddKept(both, keptBothSums + x)), bothSums + x);
    }
  }
}

/** A row of a limited field of one of the planes that are computed together. Rows take turns in little memory. */
template <typename T>
SUBDIVISION_INLINE T *
LimitedRow(const SubdivisionSweep<T> & s, const int plane, const int subset, const std::ptrdiff_t row)
{
  constexpr std::ptrdiff_t rows = SubdivisionSweep<T>::LimitedRows;
  return s.Limited[plane][subset] + (row & (rows - 1)) * s.Pitch;
}

/** Whether the fields without the row axis are needed of a row. */
template <bool VRowAxis, typename T>
SUBDIVISION_INLINE bool
HasLaneFields(const SubdivisionSweep<T> & s, const std::ptrdiff_t row)
{
  return !VRowAxis || (row >= -ValueReach && row < s.Height + ValueReach);
}

/** Whether the fields with the row axis are complete, and needed, of the row that lies a window's radius before. */
SUBDIVISION_INLINE bool
HasRowFields(const std::ptrdiff_t row)
{
  return row - SubdivisionMasks::WindowRadius >= -SecondDifferenceReach;
}

/** The limited flat fields of a row of a plane; those with the row axis, of the row a window's radius before. */
template <bool VRowAxis, typename T>
SUBDIVISION_INLINE void
LimitFlatFields(SubdivisionSweep<T> & s, const T * const plane, const std::ptrdiff_t r)
{
  auto &          buffers = s.Rows;
  const T * const row = plane + r * s.Pitch;
  const auto      limit = [&](const auto field, const auto sums, T * const result)
                       SUBDIVISION_ATTRIBUTE { LimitRow(field, sums, s.Tension, ValueReach, s.Width, result); };
  if constexpr (VRowAxis)
  {
    buffers.RowSums[0].Rotate();
    buffers.BothMinima[0].Rotate();
  }
  SumFlatDifferences<VRowAxis>(buffers, row, row + s.Pitch, s.Width);
  if (HasLaneFields<VRowAxis>(s, r))
  {
    limit(RowCurvature<T>{ row }, AlongLanes<T>{ buffers.LaneSums[0] }, LimitedRow(s, 0, LaneAxis, r));
  }
  if constexpr (VRowAxis)
  {
    WindowMinimumRow(AlongLanes<T>{ buffers.BothSums[0] }, ValueReach, s.Width, buffers.BothMinima[0][0]);
    if (HasRowFields(r))
    {
      const std::ptrdiff_t back = r - SubdivisionMasks::WindowRadius;
      T * const            curvature = buffers.RowCurvature[0];
      SecondDifferenceRow(RowsOfPlane(plane + back * s.Pitch, s.Pitch), ValueReach + 1, s.Width, curvature);
      limit(RowValues<T>{ curvature }, RowsAround<2>(buffers.RowSums[0], 0, 0), LimitedRow(s, 0, RowAxis, back));
      limit(RowCurvature<T>{ curvature },
            RowsAround<2>(buffers.BothMinima[0], 0, 0),
            LimitedRow(s, 0, BothAxesInPlane, back));
    }
  }
}

/** A row of what windows of planes keep. Loops take copies, since stores of vectors might change what is in memory. */
template <typename T>
struct WindowRow
{
  const T * MiddlePair;
  T *       OldestPair;
  T *       OldestLater;

  WindowRow(const SubdivisionPlaneWindow<T> & window, const std::ptrdiff_t offset)
    : MiddlePair(window.Pair[0] + offset)
    , OldestPair(window.Pair[1] + offset)
    , OldestLater(window.Later[1] + offset)
  {}
};

/** Of the minima in the plane of two more planes, makes those of the two windows of planes that they complete. */
template <typename T, typename TVector>
SUBDIVISION_INLINE void
AdvanceWindow(const WindowRow<T> & window, const std::ptrdiff_t x, TVector & earlier, TVector & later)
{
  T * const  oldestPair = window.OldestPair + x;
  T * const  oldestLater = window.OldestLater + x;
  const auto middlePair = Load(window.MiddlePair + x);
  const auto newestLater = later;
  const auto newestPair = MinOfSums(earlier, later);
  earlier = MinOfSums(MinOfSums(middlePair, Load(oldestPair)), earlier);
  later = MinOfSums(MinOfSums(middlePair, Load(oldestLater)), newestPair);
  Store(newestPair, oldestPair);
  Store(newestLater, oldestLater);
}

/** Of a row, the slopes between the newest planes, their curvature along the sweep, and that limited. */
template <typename T>
SUBDIVISION_INLINE void
AdvanceSlopes(SubdivisionSweep<T> & s, const std::ptrdiff_t r)
{
  const std::ptrdiff_t here = r * s.Pitch;
  auto &               buffers = s.Rows;
  for (int plane = 0; plane < 2; ++plane)
  {
    buffers.Slope[plane].Rotate();
    buffers.SweepCurvature[plane].Rotate();
  }
  T * const            earlierSlope = buffers.Slope[0][0];
  T * const            laterSlope = buffers.Slope[1][0];
  T * const            earlierCurvature = buffers.SweepCurvature[0][0];
  T * const            laterCurvature = buffers.SweepCurvature[1][0];
  T * const            earlierLimited = LimitedRow(s, 0, NoAxisInPlane, r);
  T * const            laterLimited = LimitedRow(s, 1, NoAxisInPlane, r);
  const T * const      input0 = s.Input[0] + here;
  const T * const      input1 = s.Input[1] + here;
  const T * const      input2 = s.Input[2] + here;
  const T * const      input3 = s.Input[3] + here;
  const T * const      input4 = s.Input[4] + here;
  const T * const      input5 = s.Input[5] + here;
  const auto           tension = Broadcast<T>(s.Tension);
  const auto           two = Broadcast<T>(2);
  const WindowRow<T>   window(s.SteepWindows[NoAxisInPlane], here);
  const std::ptrdiff_t end = s.Width + SumReach + 1;
  for (std::ptrdiff_t x = FirstVector<T>(SumReach + 1); x < end; x += LaneCount<T>())
  {
    const auto value1 = Hold(Load(input1 + x));
    const auto value2 = Hold(Load(input2 + x));
    const auto value3 = Hold(Load(input3 + x));
    const auto value4 = Hold(Load(input4 + x));
    const auto slope0 = Sub(Load(input0 + x), value1);
    const auto slope1 = Sub(value1, value2);
    Store(slope1, earlierSlope + x);
    Store(slope0, laterSlope + x);

    auto earlier = Comparable(Add(Magnitude(slope1), Magnitude(Sub(value2, value3))));
    auto later = Comparable(Add(Magnitude(slope0), Magnitude(slope1)));
    AdvanceWindow(window, x, earlier, later);

    const auto curvature4 = NegMulAdd(two, value4, Add(Load(input5 + x), value3));
    const auto curvature3 = NegMulAdd(two, value3, Add(value4, value2));
    Store(curvature4, earlierCurvature + x);
    Store(curvature3, laterCurvature + x);
    Store(Limit(curvature4, tension, earlier), earlierLimited + x);
    Store(Limit(curvature3, tension, later), laterLimited + x);
  }
}

/** Block sums of the steep fields with an axis in the plane, of a row of the two newest slopes. */
template <bool VRowAxis, typename T>
SUBDIVISION_INLINE void
SumSteepDifferences(const SubdivisionSweep<T> & s, const std::ptrdiff_t here)
{
  const auto &    buffers = s.Rows;
  const T * const earlierRow = buffers.Slope[0][VRowAxis ? 1 : 0];
  const T * const laterRow = buffers.Slope[1][VRowAxis ? 1 : 0];
  const T * const earlierNextRow = buffers.Slope[0][0];
  const T * const laterNextRow = buffers.Slope[1][0];
  T * const       keptLane = s.KeptSlopeSums[LaneAxis] + here;
  T * const       keptRow = s.KeptSlopeSums[RowAxis] + here;
  T * const       keptBoth = s.KeptSlopeSums[BothAxesInPlane] + here;
  // Of the parts in the two newest slopes, makes sums: with the part in the slope before, and with each other.
  const auto addSlopes = [](auto & earlier, auto & later, T * const kept) SUBDIVISION_ATTRIBUTE {
    const auto before = Load(kept);
    Store(later, kept);
    later = Add(earlier, later);
    earlier = Add(before, earlier);
  };
  // Copies, since stores of vectors might change what is in memory.
  T * const            laneSums[2] = { buffers.LaneSums[0], buffers.LaneSums[1] };
  T * const            rowSums[2] = { buffers.RowSums[0][0], buffers.RowSums[1][0] };
  T * const            bothSums[2] = { buffers.BothSums[0], buffers.BothSums[1] };
  T * const            keptRowSums[2] = { buffers.KeptRowSums[0], buffers.KeptRowSums[1] };
  T * const            keptBothSums[2] = { buffers.KeptBothSums[0], buffers.KeptBothSums[1] };
  const std::ptrdiff_t end = s.Width + SumReach;
  for (std::ptrdiff_t x = FirstVector<T>(SumReach); x < end; x += LaneCount<T>())
  {
    Vector<T> earlierLanes;
    Vector<T> earlierRows;
    Vector<T> earlierBoth;
    Vector<T> laterLanes;
    Vector<T> laterRows;
    Vector<T> laterBoth;
    SumDifferences<VRowAxis>(earlierRow, earlierNextRow, x, earlierLanes, earlierRows, earlierBoth);
    SumDifferences<VRowAxis>(laterRow, laterNextRow, x, laterLanes, laterRows, laterBoth);
    addSlopes(earlierLanes, laterLanes, keptLane + x);
    Store(Comparable(earlierLanes), laneSums[0] + x);
    Store(Comparable(laterLanes), laneSums[1] + x);
    if constexpr (VRowAxis)
    {
      addSlopes(earlierRows, laterRows, keptRow + x);
      Store(Comparable(AddKept(earlierRows, keptRowSums[0] + x)), rowSums[0] + x);
      Store(Comparable(AddKept(laterRows, keptRowSums[1] + x)), rowSums[1] + x);
      addSlopes(earlierBoth, laterBoth, keptBoth + x);
      Store(Comparable(AddKept(earlierBoth, keptBothSums[0] + x)), bothSums[0] + x);
      Store(Comparable(AddKept(laterBoth, keptBothSums[1] + x)), bothSums[1] + x);
    }
  }
}

/** Two planes' row of a steep field, limited. */
template <typename T, typename TField, typename TSums>
SUBDIVISION_INLINE void
LimitSteepRows(SubdivisionSweep<T> & s,
               const int             subset,
               const std::ptrdiff_t  r,
               const TField          earlierField,
               const TField          laterField,
               const TSums           earlierSums,
               const TSums           laterSums)
{
  const WindowRow<T>   window(s.SteepWindows[subset], r * s.Pitch);
  T * const            earlierLimited = LimitedRow(s, 0, subset, r);
  T * const            laterLimited = LimitedRow(s, 1, subset, r);
  const auto           tension = Broadcast<T>(s.Tension);
  const std::ptrdiff_t end = s.Width + ValueReach;
  for (std::ptrdiff_t x = FirstVector<T>(ValueReach); x < end; x += LaneCount<T>())
  {
    auto earlier = WindowMinimum(earlierSums, x);
    auto later = WindowMinimum(laterSums, x);
    AdvanceWindow(window, x, earlier, later);
    Store(Limit(earlierField(x), tension, earlier), earlierLimited + x);
    Store(Limit(laterField(x), tension, later), laterLimited + x);
  }
}

/** The limited steep fields of a row of the two planes whose windows the newest planes complete; those with the row
 * axis, of the row a window's radius before. The slopes of the next row are there. */
template <bool VRowAxis, typename T>
SUBDIVISION_INLINE void
LimitSteepFields(SubdivisionSweep<T> & s, const std::ptrdiff_t r)
{
  constexpr int row = VRowAxis ? 1 : 0;
  auto &        buffers = s.Rows;
  if constexpr (VRowAxis)
  {
    for (int plane = 0; plane < 2; ++plane)
    {
      buffers.RowSums[plane].Rotate();
      buffers.BothMinima[plane].Rotate();
    }
  }
  SumSteepDifferences<VRowAxis>(s, r * s.Pitch);
  if (HasLaneFields<VRowAxis>(s, r))
  {
    LimitSteepRows(s,
                   LaneAxis,
                   r,
                   RowCurvature<T>{ buffers.SweepCurvature[0][row] },
                   RowCurvature<T>{ buffers.SweepCurvature[1][row] },
                   AlongLanes<T>{ buffers.LaneSums[0] },
                   AlongLanes<T>{ buffers.LaneSums[1] });
  }
  if constexpr (VRowAxis)
  {
    for (int plane = 0; plane < 2; ++plane)
    {
      WindowMinimumRow(AlongLanes<T>{ buffers.BothSums[plane] }, ValueReach, s.Width, buffers.BothMinima[plane][0]);
    }
    if (HasRowFields(r))
    {
      const std::ptrdiff_t back = r - SubdivisionMasks::WindowRadius;
      for (int plane = 0; plane < 2; ++plane)
      {
        SecondDifferenceRow(
          RowsAround<1>(buffers.SweepCurvature[plane], 2, 0), ValueReach + 1, s.Width, buffers.RowCurvature[plane]);
      }
      LimitSteepRows(s,
                     RowAxis,
                     back,
                     RowValues<T>{ buffers.RowCurvature[0] },
                     RowValues<T>{ buffers.RowCurvature[1] },
                     RowsAround<2>(buffers.RowSums[0], 0, 0),
                     RowsAround<2>(buffers.RowSums[1], 0, 0));
      LimitSteepRows(s,
                     BothAxesInPlane,
                     back,
                     RowCurvature<T>{ buffers.RowCurvature[0] },
                     RowCurvature<T>{ buffers.RowCurvature[1] },
                     RowsAround<2>(buffers.BothMinima[0], 0, 0),
                     RowsAround<2>(buffers.BothMinima[1], 0, 0));
    }
  }
}

} // namespace SUBDIVISION_TARGET
} // namespace itk
