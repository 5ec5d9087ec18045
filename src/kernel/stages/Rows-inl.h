// SPDX-License-Identifier: Apache-2.0

// Operations on rows of values. Every target includes this file once, into its own
// namespace; the guard is toggled from target to target.

#if defined(SUBDIVISION_ROWS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef SUBDIVISION_ROWS_INL
#    undef SUBDIVISION_ROWS_INL
#  else
#    define SUBDIVISION_ROWS_INL
#  endif

#  include "kernel/stages/Masks-inl.h"
#  include "kernel/stages/Ring.h"

#  include <type_traits>

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** Where the loop over a row begins that is to reach some way beyond the tile: at a whole vector, since loads and
 * stores across cache lines cost much more than the lanes that are computed for nothing. */
template <typename T>
SUBDIVISION_INLINE std::ptrdiff_t
                   FirstVector(const std::ptrdiff_t reach)
{
  const std::ptrdiff_t lanes = LaneCount<T>();
  return -((reach + lanes - 1) / lanes * lanes);
}

/** Reads the neighbours of a voxel along its row. */
template <typename T>
struct AlongX
{
  const T * Row;

  SUBDIVISION_INLINE Vector<T>
                     operator()(std::ptrdiff_t x, int offset) const
  {
    return Load(Row + x + offset);
  }
};

/** Reads the neighbours of a voxel in rows (of one plane, or of several) from offset -VRadius on. */
template <typename T, int VRadius>
struct AcrossRows
{
  const T * Row[2 * VRadius + 1];

  SUBDIVISION_INLINE Vector<T>
                     operator()(std::ptrdiff_t x, int offset) const
  {
    return Load(Row[VRadius + offset] + x);
  }
};

/** Keeps both children of voxels along their row: a vector of lower children and one of upper ones in turns, which
 * InterleaveChildren brings into order at the very end. */
template <typename T>
struct ChildrenAlongX
{
  T * Row;

  SUBDIVISION_INLINE void
  operator()(std::ptrdiff_t x, Vector<T> lower, Vector<T> upper) const
  {
    Store(lower, Row + 2 * x);
    Store(upper, Row + 2 * x + LaneCount<T>());
  }
};

/** The minimum of a window of five. */
template <typename TSums>
SUBDIVISION_INLINE auto
WindowMinimum(const TSums sums, const std::ptrdiff_t x)
{
  return MinNonNegative(
    MinNonNegative(MinNonNegative(sums(x, -2), sums(x, -1)), MinNonNegative(sums(x, 1), sums(x, 2))), sums(x, 0));
}

template <typename T>
SUBDIVISION_INLINE auto
WindowMinimum(const AlongX<T> sums, const std::ptrdiff_t x)
{
  const Neighbours<T, 2> sum(sums.Row + x);
  const auto             before = MinNonNegative(sum.template At<-2>(), sum.template At<-1>());
  const auto             after = MinNonNegative(sum.template At<1>(), sum.template At<2>());
  return MinNonNegative(MinNonNegative(before, after), sum.template At<0>());
}

/** The second difference. */
template <typename T, typename TValues>
SUBDIVISION_INLINE auto
SecondDifference(const TValues values, const std::ptrdiff_t x)
{
  return NegMulAdd(Broadcast<T>(2), values(x, 0), Add(values(x, -1), values(x, 1)));
}

template <typename T>
SUBDIVISION_INLINE auto
SecondDifference(const AlongX<T> values, const std::ptrdiff_t x)
{
  const Neighbours<T, 1> value(values.Row + x);
  return NegMulAdd(Broadcast<T>(2), value.template At<0>(), Add(value.template At<-1>(), value.template At<1>()));
}

/** Window minima of a row or of several. */
template <typename T, typename TSums>
SUBDIVISION_INLINE void
WindowMinimumRow(const TSums sums, const std::ptrdiff_t reach, const std::ptrdiff_t width, T * const __restrict minimum)
{
  for (std::ptrdiff_t x = FirstVector<T>(reach); x < width + reach; x += LaneCount<T>())
  {
    Store(WindowMinimum(sums, x), minimum + x);
  }
}

/** The second differences of a row along one axis: G of an axis, or of one axis more, where the values are G already.
 */
template <typename T, typename TValues>
SUBDIVISION_INLINE void
SecondDifferenceRow(const TValues        values,
                    const std::ptrdiff_t reach,
                    const std::ptrdiff_t width,
                    T * const __restrict result)
{
  for (std::ptrdiff_t x = FirstVector<T>(reach); x < width + reach; x += LaneCount<T>())
  {
    Store(SecondDifference<T>(values, x), result + x);
  }
}

/** E: G limited to +-K, which is the tension times the least variation; unlimited where that is NaN. */
template <typename TVector>
SUBDIVISION_INLINE TVector
Limit(const TVector difference, const TVector tension, const TVector leastVariation)
{
  const TVector bound = Mul(tension, leastVariation);
  return OrderedMin(bound, OrderedMax(Neg(bound), difference));
}

/** Differences that are kept in a row. */
template <typename T>
struct RowValues
{
  const T * Row;

  SUBDIVISION_INLINE Vector<T>
                     operator()(std::ptrdiff_t x) const
  {
    return Load(Row + x);
  }
};

/** Differences that are taken along x of a row as they are needed. */
template <typename T>
struct SecondDifferencesAlongX
{
  const T * Row;

  SUBDIVISION_INLINE Vector<T>
                     operator()(std::ptrdiff_t x) const
  {
    return SecondDifference<T>(AlongX<T>{ Row }, x);
  }
};

/** E of a row: its differences G limited by the least of the variations H in the window. */
template <typename T, typename TDifferences, typename TVariation>
SUBDIVISION_INLINE void
LimitRow(const TDifferences   differences,
         const TVariation     variation,
         const double         tension,
         const std::ptrdiff_t reach,
         const std::ptrdiff_t width,
         T * const __restrict result)
{
  const auto factor = Broadcast<T>(tension);
  for (std::ptrdiff_t x = FirstVector<T>(reach); x < width + reach; x += LaneCount<T>())
  {
    Store(Limit(differences(x), factor, WindowMinimum(variation, x)), result + x);
  }
}

/** Calls \c use with the place of each vector of a row, some of them at a time: for loops so short that counting costs
 * as much as what they do. */
template <typename T, typename TUse>
SUBDIVISION_INLINE void
ForEachVectorInRow(const std::ptrdiff_t reach, const std::ptrdiff_t width, const TUse & use)
{
  const std::ptrdiff_t lanes = LaneCount<T>();
  const std::ptrdiff_t end = width + reach;
  std::ptrdiff_t       x = FirstVector<T>(reach);
  if constexpr (AreLoopsUnrolled)
  {
    for (; x + 3 * lanes < end; x += 4 * lanes)
    {
      use(x);
      use(x + lanes);
      use(x + 2 * lanes);
      use(x + 3 * lanes);
    }
  }
  for (; x < end; x += lanes)
  {
    use(x);
  }
}

/** A copy of a row. */
template <typename T>
SUBDIVISION_INLINE void
CopyRow(const T * const __restrict values,
        const std::ptrdiff_t reach,
        const std::ptrdiff_t width,
        T * const __restrict result)
{
  ForEachVectorInRow<T>(
    reach, width, [=](const std::ptrdiff_t x) SUBDIVISION_ATTRIBUTE { Store(Load(values + x), result + x); });
}

/** Sets a row to a multiple of itself. */
template <typename T>
SUBDIVISION_INLINE void
ScaleRow(const double factor, const std::ptrdiff_t reach, const std::ptrdiff_t width, T * const row)
{
  const auto by = Broadcast<T>(factor);
  ForEachVectorInRow<T>(
    reach, width, [=, &by](const std::ptrdiff_t x) SUBDIVISION_ATTRIBUTE { Store(Mul(by, Load(row + x)), row + x); });
}

/** Entries of a ring around one of them: rows of a plane, or rows of planes that lie \c offset values into these. */
template <int VRadius, typename T, int VLength>
SUBDIVISION_INLINE AcrossRows<T, VRadius>
                   Around(const Ring<T, VLength> & ring, const std::ptrdiff_t number, const std::ptrdiff_t offset = 0)
{
  AcrossRows<T, VRadius> rows;
  T * const * const      entries = ring.From(number - VRadius, 2 * VRadius + 1);
  for (int i = 0; i <= 2 * VRadius; ++i)
  {
    rows.Row[i] = entries[i] + offset;
  }
  return rows;
}

/** Rows around row r; \c rowOf gives a row by its number. */
template <int VRadius, typename T, typename TRow>
SUBDIVISION_INLINE AcrossRows<T, VRadius>
                   AroundRow(const TRow & rowOf, const std::ptrdiff_t r)
{
  AcrossRows<T, VRadius> rows;
  for (int i = 0; i <= 2 * VRadius; ++i)
  {
    rows.Row[i] = rowOf(r - VRadius + i);
  }
  return rows;
}

// What the stages of limited differences share.

/** The subsets of the axes of a plane, as bits. */
enum AxesInPlane
{
  NoAxis = 0,
  XAxis = 1,
  YAxis = 2,
  BothAxes = XAxis | YAxis,
  SubsetsInPlane = 4
};

/** How far beyond the tile variations are needed. */
constexpr std::ptrdiff_t VariationReach = SecondDifferenceRadius + WindowRadius;

/** Carried voxels have no neighbours along x. */
template <bool VX>
constexpr std::ptrdiff_t
ReachAlongX(const std::ptrdiff_t reach)
{
  return VX ? reach : 0;
}

/** Whether the differences of the subsets without y are needed of a row. */
template <bool VY>
SUBDIVISION_INLINE bool
HasRowWithoutY(const Shape & shape, const std::ptrdiff_t r)
{
  return !VY || (r >= -ValueRadius && r < shape.Height + ValueRadius);
}

/** A row of a plane and those before and after it. */
template <typename T>
SUBDIVISION_INLINE AcrossRows<T, 1>
                   RowsOfPlane(const T * const row, const std::ptrdiff_t pitch)
{
  return AcrossRows<T, 1>{ { row - pitch, row, row + pitch } };
}

/** \brief Some rows of limited differences, by subset of the axes in the plane.
 *
 * They are limited block by block before they are filtered: few rows, so that the cache still holds them; not one by
 * one, or what either step keeps from row to row would leave the first-level cache. */
template <typename T>
class LimitedRows
{
public:
  static constexpr std::ptrdiff_t RowsPerBlock = 16;

  void
  Allocate(Layout<T> & layout)
  {
    m_Pitch = layout.GetPitch();
    for (T *& rows : m_Rows)
    {
      rows = layout.TakeRows(Places);
    }
  }

  SUBDIVISION_INLINE T *
  Row(const int subset, const std::ptrdiff_t r) const
  {
    return m_Rows[subset] + (r & (Places - 1)) * m_Pitch;
  }

private:
  /** A power of two that holds the rows of a block and those before them that are still needed. */
  static constexpr std::ptrdiff_t Places = 2 * RowsPerBlock;

  T *            m_Rows[SubsetsInPlane];
  std::ptrdiff_t m_Pitch;
};

/** The parts that a row and the one after it have in the variations of the row's voxels, for each subset of the axes.
 * They are no struct, and closures have vectors by reference: those whose length is known only when they run (SVE) can
 * be no members. */
template <bool VX, bool VY, typename T, typename TVector>
SUBDIVISION_INLINE void
SumDifferences(const T * const      row,
               const T * const      nextRow,
               const std::ptrdiff_t x,
               TVector &            partX,
               TVector &            partY,
               TVector &            partBoth)
{
  const auto value = KeepInRegister(Load(row + x));
  if constexpr (VX)
  {
    const auto before = KeepInRegister(Load(row + x - 1));
    const auto after = KeepInRegister(Load(row + x + 1));
    partX = Add(Magnitude(Sub(value, before)), Magnitude(Sub(after, value)));
    if constexpr (VY)
    {
      const auto difference = Sub(Load(nextRow + x), value);
      const auto differenceBefore = Sub(Load(nextRow + x - 1), before);
      const auto differenceAfter = Sub(Load(nextRow + x + 1), after);
      partY = Magnitude(difference);
      partBoth = Add(Magnitude(Sub(difference, differenceBefore)), Magnitude(Sub(differenceAfter, difference)));
    }
  }
  else if constexpr (VY)
  {
    partY = Magnitude(Sub(Load(nextRow + x), value));
  }
}

/** Adds the part that the previous row or plane left, and leaves this one. */
template <typename T, typename TVector>
SUBDIVISION_INLINE TVector
AddPrevious(const TVector part, T * const previous)
{
  const auto sum = Add(Load(previous), part);
  Store(part, previous);
  return sum;
}

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk

#endif
