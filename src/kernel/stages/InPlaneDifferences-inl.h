// SPDX-License-Identifier: Apache-2.0

// Limited second differences along the axes of a plane (docs/scheme.md, section 3). No include guard: every target
// includes this file once, into its own namespace.

#include "kernel/stages/Rows-inl.h"

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** \brief Stage: E_A of the subsets A of the axes x and y, of a plane, row by row.
 *
 * G_A are the second differences along the axes of A, H_A the variation, K_A the tension times the least H_A of a
 * window of five along each axis of A, and E_A is G_A within +-K_A. */
template <typename T, bool VX, bool VY>
class InPlaneDifferences
{
public:
  void
  Allocate(Layout<T> & layout)
  {
    m_Limited.Allocate(layout);
    for (T ** const row : { &m_XVariation, &m_BothVariation, &m_PreviousYPart, &m_PreviousBothPart, &m_YDifferences })
    {
      *row = layout.TakeRows();
    }
    m_YVariation.AllocateRows(layout);
    m_BothMinima.AllocateRows(layout);
  }

  /** Row r of E_A. */
  SUBDIVISION_INLINE const T *
  GetRow(const int subset, const std::ptrdiff_t r) const
  {
    return m_Limited.Row(subset, r);
  }

  /** Takes row r of a plane, from -VariationReach - 1 on, and the one after it: E_x of row r, and of row r - 2 those of
   * the subsets with y. */
  SUBDIVISION_INLINE void
  Advance(const Shape & shape, const T * const plane, const std::ptrdiff_t r, const double tension)
  {
    const T * const row = plane + r * shape.Pitch;
    const auto      limit = [&](const auto differences, const auto variation, T * const result) SUBDIVISION_ATTRIBUTE {
      LimitRow(differences, variation, tension, ReachAlongX<VX>(ValueRadius), shape.Width, result);
    };
    this->FindVariation(row, row + shape.Pitch, r, shape.Width);
    if constexpr (VX)
    {
      if (HasRowWithoutY<VY>(shape, r))
      {
        limit(SecondDifferencesAlongX<T>{ row }, AlongX<T>{ m_XVariation }, m_Limited.Row(XAxis, r));
      }
    }
    if constexpr (VY)
    {
      const std::ptrdiff_t centre = r - WindowRadius;
      if constexpr (VX)
      {
        WindowMinimumRow(AlongX<T>{ m_BothVariation }, ValueRadius, shape.Width, m_BothMinima.Begin(r));
      }
      if (centre >= -SecondDifferenceRadius)
      {
        SecondDifferenceRow(RowsOfPlane(plane + centre * shape.Pitch, shape.Pitch),
                            ReachAlongX<VX>(ValueRadius + 1),
                            shape.Width,
                            m_YDifferences);
        limit(RowValues<T>{ m_YDifferences }, Around<WindowRadius>(m_YVariation, centre), m_Limited.Row(YAxis, centre));
        if constexpr (VX)
        {
          limit(SecondDifferencesAlongX<T>{ m_YDifferences },
                Around<WindowRadius>(m_BothMinima, centre),
                m_Limited.Row(BothAxes, centre));
        }
      }
    }
  }

private:
  /** H_A of a row. */
  SUBDIVISION_INLINE void
  FindVariation(const T * const row, const T * const nextRow, const std::ptrdiff_t r, const std::ptrdiff_t width)
  {
    if constexpr (!VX && !VY)
    {
      return;
    }
    constexpr std::ptrdiff_t reach = ReachAlongX<VX>(VariationReach);
    // Copies, since stores of vectors might change what is in memory.
    T * const xVariation = m_XVariation;
    T * const yVariation = m_YVariation.Begin(r);
    T * const bothVariation = m_BothVariation;
    T * const previousY = m_PreviousYPart;
    T * const previousBoth = m_PreviousBothPart;
    for (std::ptrdiff_t x = FirstVector<T>(reach); x < width + reach; x += LaneCount<T>())
    {
      Vector<T> partX;
      Vector<T> partY;
      Vector<T> partBoth;
      SumDifferences<VX, VY>(row, nextRow, x, partX, partY, partBoth);
      if constexpr (VX)
      {
        Store(ToOrderedBits(partX), xVariation + x);
      }
      if constexpr (VY)
      {
        Store(ToOrderedBits(AddPrevious(partY, previousY + x)), yVariation + x);
      }
      if constexpr (VX && VY)
      {
        Store(ToOrderedBits(AddPrevious(partBoth, previousBoth + x)), bothVariation + x);
      }
    }
  }

  LimitedRows<T>                m_Limited;
  T *                           m_XVariation;
  T *                           m_BothVariation;
  T *                           m_PreviousYPart;
  T *                           m_PreviousBothPart;
  T *                           m_YDifferences;
  Ring<T, 2 * WindowRadius + 1> m_YVariation;
  Ring<T, 2 * WindowRadius + 1> m_BothMinima;
};

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
