// SPDX-License-Identifier: Apache-2.0

// Operations on rows of values. No include guard: every target includes this file once, into its own namespace.

#include "itkSubdivisionMasks.h"

#include <type_traits>

namespace itk
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
struct AlongLanes
{
  const T * Row;

  SUBDIVISION_INLINE Vector<T>
                     operator()(std::ptrdiff_t x, int offset) const
  {
    return Load(Row + x + offset);
  }
};

/** Reads the neighbours of a voxel in rows (of one plane, or of several) of which entry 0 is the one with the largest
 * offset, VRadius. */
template <typename T, int VRadius>
struct AcrossRows
{
  const T * Row[2 * VRadius + 1];

  SUBDIVISION_INLINE Vector<T>
                     operator()(std::ptrdiff_t x, int offset) const
  {
    return Load(Row[VRadius - offset] + x);
  }
};

/** Keeps both children of voxels along their row: a vector of lower children and one of upper ones in turns, which
 * InterleaveChildren brings into order at the very end. */
template <typename T>
struct ChildrenAlongLanes
{
  T * Row;

  SUBDIVISION_INLINE void
  operator()(std::ptrdiff_t x, Vector<T> before, Vector<T> after) const
  {
    Store(before, Row + 2 * x);
    Store(after, Row + 2 * x + LaneCount<T>());
  }
};

/** Keeps both children of voxels across rows: each in a row of its own. */
template <typename T>
struct ChildrenAcrossRows
{
  T * Before;
  T * After;

  SUBDIVISION_INLINE void
  operator()(std::ptrdiff_t x, Vector<T> before, Vector<T> after) const
  {
    Store(before, Before + x);
    Store(after, After + x);
  }
};

/** Stands for second differences where a scheme has none. */
struct NoSecondDifferences
{};

/** A mask in the form in which both children share their work: child 1, the upper half of the voxel, weighs the voxel
 * itself with Centre, those at offset +i and -i with Pair[i-1] +- Odd[i-1], and the last one, on its own side only,
 * with Outer. Child 0 is its mirror image. */
template <int VPairs>
struct SharedMask
{
  double Centre;
  double Pair[VPairs];
  double Odd[VPairs];
  double Outer;

  template <typename TMask>
  static constexpr SharedMask
  FromMask(const TMask & mask)
  {
    constexpr double scale = 1.0 / SubdivisionMasks::Denominator;
    SharedMask       shared{};
    shared.Centre = scale * mask[VPairs];
    for (int i = 1; i <= VPairs; ++i)
    {
      shared.Pair[i - 1] = scale * (mask[VPairs + i] + mask[VPairs - i]) / 2;
      shared.Odd[i - 1] = scale * (mask[VPairs + i] - mask[VPairs - i]) / 2;
    }
    shared.Outer = scale * mask[2 * VPairs + 1];
    return shared;
  }
};

constexpr auto BSplineMask = SharedMask<2>::FromMask(SubdivisionMasks::BSpline);
constexpr auto LinearMask = SharedMask<2>::FromMask(SubdivisionMasks::Linear);
constexpr auto SecondDifferenceMask = SharedMask<1>::FromMask(SubdivisionMasks::SecondDifference);

/** Both children along one axis of every voxel of a row, and of \c reach voxels on either side: the values under a mask
 * of six taps, plus the second differences, if any, under theirs. */
template <typename T, typename TValues, typename TSecondDifferences, typename TChildren>
SUBDIVISION_INLINE void
FilterRow(const TValues            values,
          const TSecondDifferences secondDifferences,
          const SharedMask<2> &    mask,
          const std::ptrdiff_t     reach,
          const std::ptrdiff_t     width,
          const TChildren          children)
{
  const auto centre = Broadcast<T>(mask.Centre);
  const auto pair1 = Broadcast<T>(mask.Pair[0]);
  const auto pair2 = Broadcast<T>(mask.Pair[1]);
  const auto odd1 = Broadcast<T>(mask.Odd[0]);
  const auto odd2 = Broadcast<T>(mask.Odd[1]);
  const auto outer = Broadcast<T>(mask.Outer);
  const auto curvedCentre = Broadcast<T>(SecondDifferenceMask.Centre);
  const auto curvedPair = Broadcast<T>(SecondDifferenceMask.Pair[0]);
  const auto curvedOdd = Broadcast<T>(SecondDifferenceMask.Odd[0]);
  const auto curvedOuter = Broadcast<T>(SecondDifferenceMask.Outer);

  for (std::ptrdiff_t x = FirstVector<T>(reach); x < width + reach; x += LaneCount<T>())
  {
    const auto before2 = Hold(values(x, -2));
    const auto before1 = Hold(values(x, -1));
    const auto after1 = Hold(values(x, 1));
    const auto after2 = Hold(values(x, 2));
    auto       even = Mul(pair2, Add(after2, before2));
    auto       odd = Mul(odd2, Sub(after2, before2));
    even = MulAdd(pair1, Add(after1, before1), even);
    odd = MulAdd(odd1, Sub(after1, before1), odd);
    even = MulAdd(centre, values(x, 0), even);
    if constexpr (!std::is_same<TSecondDifferences, NoSecondDifferences>::value)
    {
      const auto curvedBefore = Hold(secondDifferences(x, -1));
      const auto curvedAfter = Hold(secondDifferences(x, 1));
      even = MulAdd(curvedPair, Add(curvedAfter, curvedBefore), even);
      odd = MulAdd(curvedOdd, Sub(curvedAfter, curvedBefore), odd);
      even = MulAdd(curvedCentre, secondDifferences(x, 0), even);
    }
    auto rightOfCentre = MulAdd(outer, values(x, 3), odd);
    auto leftOfCentre = MulSub(outer, values(x, -3), odd);
    if constexpr (!std::is_same<TSecondDifferences, NoSecondDifferences>::value)
    {
      rightOfCentre = MulAdd(curvedOuter, secondDifferences(x, 2), rightOfCentre);
      leftOfCentre = MulAdd(curvedOuter, secondDifferences(x, -2), leftOfCentre);
    }
    children(x, Add(even, leftOfCentre), Add(even, rightOfCentre));
  }
}

/** The minimum of a window of five. */
template <typename TSums>
SUBDIVISION_INLINE auto
WindowMinimum(const TSums sums, const std::ptrdiff_t x)
{
  return MinOfSums(MinOfSums(MinOfSums(sums(x, -2), sums(x, -1)), MinOfSums(sums(x, 1), sums(x, 2))), sums(x, 0));
}

template <typename T>
SUBDIVISION_INLINE auto
WindowMinimum(const AlongLanes<T> sums, const std::ptrdiff_t x)
{
  const Neighbours<T, 2> sum(sums.Row + x);
  const auto             before = MinOfSums(sum.template At<-2>(), sum.template At<-1>());
  const auto             after = MinOfSums(sum.template At<1>(), sum.template At<2>());
  return MinOfSums(MinOfSums(before, after), sum.template At<0>());
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
SecondDifference(const AlongLanes<T> values, const std::ptrdiff_t x)
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

/** A field of second differences (of curvature along the axes that it was taken along so far) along one axis more. */
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

/** A value limited to +- tension times the threshold; unlimited where the threshold is NaN. */
template <typename TVector>
SUBDIVISION_INLINE TVector
Limit(const TVector value, const TVector tension, const TVector threshold)
{
  const TVector bound = Mul(tension, threshold);
  return OrderedMin(bound, OrderedMax(Neg(bound), value));
}

/** A field that is the values of a row themselves. */
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

/** A field that is the second differences along the lanes of a row. */
template <typename T>
struct RowCurvature
{
  const T * Row;

  SUBDIVISION_INLINE Vector<T>
                     operator()(std::ptrdiff_t x) const
  {
    return SecondDifference<T>(AlongLanes<T>{ Row }, x);
  }
};

/** A field limited by the window minimum of the sums. */
template <typename T, typename TField, typename TSums>
SUBDIVISION_INLINE void
LimitRow(const TField         field,
         const TSums          sums,
         const double         tension,
         const std::ptrdiff_t reach,
         const std::ptrdiff_t width,
         T * const __restrict result)
{
  const auto factor = Broadcast<T>(tension);
  for (std::ptrdiff_t x = FirstVector<T>(reach); x < width + reach; x += LaneCount<T>())
  {
    Store(Limit(field(x), factor, WindowMinimum(sums, x)), result + x);
  }
}

/** The smallest of three neighbours in one set of values and the largest in another. */
template <typename T, typename TValues>
SUBDIVISION_INLINE void
FindExtrema(const TValues        smallestOf,
            const TValues        largestOf,
            const std::ptrdiff_t end,
            T * const __restrict smallest,
            T * const __restrict largest)
{
  for (std::ptrdiff_t x = 0; x < end; x += LaneCount<T>())
  {
    Store(OrderedMin(OrderedMin(smallestOf(x, -1), smallestOf(x, 0)), smallestOf(x, 1)), smallest + x);
    Store(OrderedMax(OrderedMax(largestOf(x, -1), largestOf(x, 0)), largestOf(x, 1)), largest + x);
  }
}

template <typename T>
SUBDIVISION_INLINE void
CopyRow(const T * const __restrict values,
        const std::ptrdiff_t reach,
        const std::ptrdiff_t width,
        T * const __restrict result)
{
  for (std::ptrdiff_t x = FirstVector<T>(reach); x < width + reach; x += LaneCount<T>())
  {
    Store(Load(values + x), result + x);
  }
}

} // namespace SUBDIVISION_TARGET
} // namespace itk
