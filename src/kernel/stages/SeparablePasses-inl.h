// SPDX-License-Identifier: Apache-2.0

// Children along each axis in turn. No include guard: every target includes this file once, into its own namespace.

#include "kernel/stages/Rows-inl.h"

#include <type_traits>

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** Keeps both children of voxels across rows: each in a row of its own. */
template <typename T>
struct ChildrenInTwoRows
{
  T * Lower;
  T * Upper;

  SUBDIVISION_INLINE void
  operator()(std::ptrdiff_t x, Vector<T> lower, Vector<T> upper) const
  {
    Store(lower, Lower + x);
    Store(upper, Upper + x);
  }
};

/** Stands for second differences where a scheme has none. */
struct NoSecondDifferences
{};

/** Both children along one axis of every voxel of a row, and of \c reach voxels on either side: the values under a mask
 * of six taps, plus the second differences, if any, under theirs. What both children have in common is computed once:
 * they are even + odd and even - odd, but for the outermost tap of either. */
template <typename T, typename TValues, typename TSecondDifferences, typename TChildren>
SUBDIVISION_INLINE void
FilterRow(const TValues            values,
          const TSecondDifferences secondDifferences,
          const PassMasks &        masks,
          const std::ptrdiff_t     reach,
          const std::ptrdiff_t     width,
          const TChildren          children)
{
  const auto centre = Broadcast<T>(masks.Values.Centre);
  const auto pair1 = Broadcast<T>(masks.Values.Pair[0]);
  const auto pair2 = Broadcast<T>(masks.Values.Pair[1]);
  const auto odd1 = Broadcast<T>(masks.Values.Odd[0]);
  const auto odd2 = Broadcast<T>(masks.Values.Odd[1]);
  const auto outer = Broadcast<T>(masks.Values.Outer);
  const auto secondCentre = Broadcast<T>(masks.SecondDifferences.Centre);
  const auto secondPair = Broadcast<T>(masks.SecondDifferences.Pair[0]);
  const auto secondOdd = Broadcast<T>(masks.SecondDifferences.Odd[0]);
  const auto secondOuter = Broadcast<T>(masks.SecondDifferences.Outer);

  SUBDIVISION_INDEPENDENT
  for (std::ptrdiff_t x = FirstVector<T>(reach); x < width + reach; x += LaneCount<T>())
  {
    const auto before2 = KeepInRegister(values(x, -2));
    const auto before1 = KeepInRegister(values(x, -1));
    const auto after1 = KeepInRegister(values(x, 1));
    const auto after2 = KeepInRegister(values(x, 2));
    auto       even = Mul(pair2, Add(after2, before2));
    auto       odd = Mul(odd2, Sub(after2, before2));
    even = MulAdd(pair1, Add(after1, before1), even);
    odd = MulAdd(odd1, Sub(after1, before1), odd);
    even = MulAdd(centre, values(x, 0), even);
    if constexpr (!std::is_same<TSecondDifferences, NoSecondDifferences>::value)
    {
      const auto secondBefore = KeepInRegister(secondDifferences(x, -1));
      const auto secondAfter = KeepInRegister(secondDifferences(x, 1));
      even = MulAdd(secondPair, Add(secondAfter, secondBefore), even);
      odd = MulAdd(secondOdd, Sub(secondAfter, secondBefore), odd);
      even = MulAdd(secondCentre, secondDifferences(x, 0), even);
    }
    auto upper = MulAdd(outer, values(x, 3), odd);
    auto lower = MulSub(outer, values(x, -3), odd);
    if constexpr (!std::is_same<TSecondDifferences, NoSecondDifferences>::value)
    {
      upper = MulAdd(secondOuter, secondDifferences(x, 2), upper);
      lower = MulAdd(secondOuter, secondDifferences(x, -2), lower);
    }
    children(x, Add(even, lower), Add(even, upper));
  }
}

/** \brief Stage: masks along y, z and x.
 *
 * Keeps the children along y of some planes: of the values, and with second differences (VDifferences) of those along
 * z. Where x is subdivided, each of them is a pair of terms, by whether the second differences were taken along x, too.
 * Along axes that are not subdivided, rows pass as they are. */
template <typename T, bool VX, bool VY, bool VDifferences>
class SeparablePasses
{
public:
  static constexpr int Terms = VDifferences && VX ? 2 : 1;
  static constexpr int ChildrenAlongY = VY ? Children : 1;
  using ValueRing = Ring<T, 2 * ValueRadius + PlanesPerStep>;
  using DifferenceRing = Ring<T, 2 * SecondDifferenceRadius + PlanesPerStep>;

  void
  Allocate(Layout<T> & layout)
  {
    for (int y = 0; y < ChildrenAlongY; ++y)
    {
      for (int term = 0; term < Terms; ++term)
      {
        m_Values[y][term].AllocatePlanesWithoutHalo(layout);
        if (VDifferences)
        {
          m_Differences[y][term].AllocatePlanesWithoutHalo(layout);
        }
      }
    }
    for (auto & plane : m_Rows)
    {
      for (auto & child : plane)
      {
        for (int term = 0; term < Terms; ++term)
        {
          child[term] = layout.TakeRows();
        }
      }
    }
  }

  ValueRing (&Values())[Children][2] { return m_Values; }
  DifferenceRing (&Differences())[Children][2] { return m_Differences; }

  /** Children along y of rows \c first to \c end of plane p. \c values(term, r) gives row r of what is filtered,
   * \c differences(term, r) its limited second differences along y. */
  template <typename TRing, typename TValues, typename TDifferences>
  static SUBDIVISION_INLINE void
  FilterAlongY(const Shape &        shape,
               const std::ptrdiff_t first,
               const std::ptrdiff_t end,
               const PassMasks &    masks,
               const TValues &      values,
               const TDifferences & differences,
               TRing &              ring,
               const std::ptrdiff_t p)
  {
    for (int term = 0; term < Terms; ++term)
    {
      const auto valuesOf = [&](const std::ptrdiff_t r) { return values(term, r); };
      if constexpr (!VY)
      {
        CopyRow(valuesOf(0), ReachOf(term), shape.Width, ring[0][term].Begin(p));
      }
      else
      {
        T * const lower = first == 0 ? ring[0][term].Begin(p) : ring[0][term][p];
        T * const upper = first == 0 ? ring[1][term].Begin(p) : ring[1][term][p];
        for (std::ptrdiff_t r = first; r < end; ++r)
        {
          const auto                 differencesOf = [&](const std::ptrdiff_t q) { return differences(term, q); };
          const ChildrenInTwoRows<T> children{ lower + r * shape.Pitch, upper + r * shape.Pitch };
          FilterRow<T>(AroundRow<ValueRadius, T>(valuesOf, r),
                       DifferencesOf<VDifferences>::AroundRow(differencesOf, r),
                       masks,
                       ReachOf(term),
                       shape.Width,
                       children);
        }
      }
    }
  }

  /** Children along z of a row of children along y, in some planes from \c first on. */
  SUBDIVISION_INLINE void
  FilterAlongZ(const Shape &        shape,
               const bool           hasZ,
               const PassMasks &    masks,
               const std::ptrdiff_t row,
               const int            yChild,
               const std::ptrdiff_t first,
               const int            planes)
  {
    const std::ptrdiff_t offset = row * shape.Pitch;
    for (int term = 0; term < Terms; ++term)
    {
      const ValueRing &      values = m_Values[yChild][term];
      const DifferenceRing & differences = m_Differences[yChild][term];
      for (int i = 0; i < planes; ++i)
      {
        const ChildrenInTwoRows<T> children{ m_Rows[i][0][term], m_Rows[i][1][term] };
        if (!hasZ)
        {
          CopyRow(values[first + i] + offset, ReachOf(term), shape.Width, children.Lower);
        }
        else
        {
          FilterRow<T>(Around<ValueRadius>(values, first + i, offset),
                       DifferencesOf<VDifferences>::Around(differences, first + i, offset),
                       masks,
                       ReachOf(term),
                       shape.Width,
                       children);
        }
      }
    }
  }

  /** One of these rows, where x is carried. */
  SUBDIVISION_INLINE T *
  GetRow(const int plane, const int zChild) const
  {
    return m_Rows[plane][zChild][0];
  }

  /** Children along x of one of these rows, where x is subdivided. */
  template <typename TChildren>
  SUBDIVISION_INLINE void
  FilterAlongX(const Shape &     shape,
               const PassMasks & masks,
               const int         plane,
               const int         zChild,
               const TChildren & children) const
  {
    const auto &    row = m_Rows[plane][zChild];
    const AlongX<T> values{ row[0] };
    if constexpr (VDifferences)
    {
      FilterRow<T>(values, AlongX<T>{ row[1] }, masks, 0, shape.Width, children);
    }
    else
    {
      FilterRow<T>(values, NoSecondDifferences{}, masks, 0, shape.Width, children);
    }
  }

private:
  /** How far beyond the tile the pass along x reads a term. */
  static SUBDIVISION_INLINE std::ptrdiff_t
                            ReachOf(const int term)
  {
    return !VX ? 0 : term == 0 ? ValueRadius : SecondDifferenceRadius;
  }

  /** The second differences of a pass, or none. */
  template <bool VPresent, typename TDummy = void>
  struct DifferencesOf
  {
    template <typename TRow>
    static SUBDIVISION_INLINE auto
    AroundRow(const TRow & rowOf, const std::ptrdiff_t r)
    {
      return SUBDIVISION_TARGET::AroundRow<SecondDifferenceRadius, T>(rowOf, r);
    }
    static SUBDIVISION_INLINE auto
    Around(const DifferenceRing & ring, const std::ptrdiff_t p, const std::ptrdiff_t offset)
    {
      return SUBDIVISION_TARGET::Around<SecondDifferenceRadius>(ring, p, offset);
    }
  };
  template <typename TDummy>
  struct DifferencesOf<false, TDummy>
  {
    template <typename TRow>
    static SUBDIVISION_INLINE NoSecondDifferences
    AroundRow(const TRow &, std::ptrdiff_t)
    {
      return {};
    }
    static SUBDIVISION_INLINE NoSecondDifferences
    Around(const DifferenceRing &, std::ptrdiff_t, std::ptrdiff_t)
    {
      return {};
    }
  };

  ValueRing      m_Values[Children][2];
  DifferenceRing m_Differences[Children][2];
  // By [plane of the step][child along z][term].
  T * m_Rows[PlanesPerStep][Children][2];
};

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
