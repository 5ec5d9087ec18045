// SPDX-License-Identifier: Apache-2.0

// Children along each axis in turn. No include guard: every target includes this file once, into its own namespace.

#include "kernel/stages/Rows-inl.h"

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

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
