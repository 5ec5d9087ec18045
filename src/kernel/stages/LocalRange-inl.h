// SPDX-License-Identifier: Apache-2.0

// The range of a voxel's neighbours. No include guard: every target includes this file once, into its own namespace.

#include "kernel/stages/Rows-inl.h"

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** The least of three neighbours in one set of values and the greatest in another. */
template <typename T, typename TValues>
SUBDIVISION_INLINE void
FindExtrema(const TValues        leastOf,
            const TValues        greatestOf,
            const std::ptrdiff_t end,
            T * const __restrict least,
            T * const __restrict greatest)
{
  for (std::ptrdiff_t x = 0; x < end; x += LaneCount<T>())
  {
    Store(OrderedMin(OrderedMin(leastOf(x, -1), leastOf(x, 0)), leastOf(x, 1)), least + x);
    Store(OrderedMax(OrderedMax(greatestOf(x, -1), greatestOf(x, 0)), greatestOf(x, 1)), greatest + x);
  }
}

/** \brief Stage: the least and the greatest of the 3^d voxels around each voxel, along the subdivided axes. */
template <typename T, bool VX, bool VY>
class LocalRange
{
public:
  void
  Allocate(Layout<T> & layout)
  {
    m_Least.AllocatePlanesWithoutHalo(layout);
    m_Greatest.AllocatePlanesWithoutHalo(layout);
    m_LeastAlongX.AllocateRows(layout);
    m_GreatestAlongX.AllocateRows(layout);
    for (int i = 0; i < PlanesPerStep; ++i)
    {
      m_LowOfRow[i] = layout.TakeRows();
      m_HighOfRow[i] = layout.TakeRows();
    }
  }

  /** Takes plane p: the range within it. */
  void
  Advance(const Shape & shape, const T * const plane, const std::ptrdiff_t p)
  {
    T * const least = m_Least.Begin(p);
    T * const greatest = m_Greatest.Begin(p);
    if constexpr (!VY)
    {
      FindAlongX(plane, shape.Width, least, greatest);
    }
    else
    {
      for (std::ptrdiff_t r = -1; r <= shape.Height; ++r)
      {
        FindAlongX(plane + r * shape.Pitch, shape.Width, m_LeastAlongX.Begin(r), m_GreatestAlongX.Begin(r));
        if (r >= 1)
        {
          const std::ptrdiff_t centre = (r - 1) * shape.Pitch;
          FindExtrema(Around<1>(m_LeastAlongX, r - 1),
                      Around<1>(m_GreatestAlongX, r - 1),
                      shape.Width,
                      least + centre,
                      greatest + centre);
        }
      }
    }
  }

  /** The range of the voxels of a row of plane p, which is number i of its step. */
  SUBDIVISION_INLINE void
  FindRow(const Shape & shape, const bool hasZ, const std::ptrdiff_t row, const std::ptrdiff_t p, const int i)
  {
    const std::ptrdiff_t offset = row * shape.Pitch;
    if (hasZ)
    {
      FindExtrema(
        Around<1>(m_Least, p, offset), Around<1>(m_Greatest, p, offset), shape.Width, m_LowOfRow[i], m_HighOfRow[i]);
    }
    else
    {
      CopyRow(m_Least[p] + offset, 0, shape.Width, m_LowOfRow[i]);
      CopyRow(m_Greatest[p] + offset, 0, shape.Width, m_HighOfRow[i]);
    }
  }

  SUBDIVISION_INLINE const T *
  GetLow(const int i) const
  {
    return m_LowOfRow[i];
  }

  SUBDIVISION_INLINE const T *
  GetHigh(const int i) const
  {
    return m_HighOfRow[i];
  }

private:
  static SUBDIVISION_INLINE void
  FindAlongX(const T * const row, const std::ptrdiff_t width, T * const least, T * const greatest)
  {
    if constexpr (VX)
    {
      const AlongX<T> values{ row };
      FindExtrema(values, values, width, least, greatest);
    }
    else
    {
      CopyRow(row, 0, width, least);
      CopyRow(row, 0, width, greatest);
    }
  }

  /** Planes are taken as soon as values are, ValueRadius planes before their children are complete. */
  static constexpr int RangePlanes = 2 * ValueRadius + PlanesPerStep;

  Ring<T, RangePlanes> m_Least;
  Ring<T, RangePlanes> m_Greatest;
  Ring<T, 3>           m_LeastAlongX;
  Ring<T, 3>           m_GreatestAlongX;
  T *                  m_LowOfRow[PlanesPerStep];
  T *                  m_HighOfRow[PlanesPerStep];
};

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
