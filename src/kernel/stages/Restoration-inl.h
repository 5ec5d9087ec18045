// SPDX-License-Identifier: Apache-2.0

// The limit of the restored scheme (docs/scheme.md, section 4). No include guard: every target includes this file once,
// into its own namespace.

#include "kernel/stages/Rows-inl.h"

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** \brief Stage: T = 4 tension m (m / X), where m and X are the least and the greatest variation H of the 5^d voxels
 * around each voxel, along the subdivided axes; 0 where X is 0 or not finite. */
template <typename T, bool VX, bool VY>
class Restoration
{
public:
  void
  Allocate(Layout<T> & layout)
  {
    m_Least.AllocatePlanesWithoutHalo(layout);
    m_Greatest.AllocatePlanesWithoutHalo(layout);
    m_LeastAlongX.AllocateRows(layout);
    m_GreatestAlongX.AllocateRows(layout);
    m_Variation = layout.TakeRows();
    for (T *& limit : m_LimitOfRow)
    {
      limit = layout.TakeRows();
    }
  }

  /** Finds m and X of plane p within it; along z it takes the planes on either side. */
  template <typename TInput>
  void
  Advance(const Shape & shape, const TInput & input, const std::ptrdiff_t p, const bool hasZ)
  {
    T * const leastOfPlane = m_Least.Begin(p);
    T * const greatestOfPlane = m_Greatest.Begin(p);
    for (std::ptrdiff_t r = VY ? -WindowRadius : 0; r < (VY ? shape.Height + WindowRadius : 1); ++r)
    {
      this->FindVariation(shape, input.FromAny(p - 1), r * shape.Pitch, hasZ);
      T * const least = VY ? m_LeastAlongX.Begin(r) : leastOfPlane;
      T * const greatest = VY ? m_GreatestAlongX.Begin(r) : greatestOfPlane;
      if constexpr (VX)
      {
        const AlongX<T> variation{ m_Variation };
        FindInWindow(variation, variation, shape.Width, Keep{ least, greatest });
      }
      else
      {
        CopyRow(m_Variation, 0, shape.Width, least);
        CopyRow(m_Variation, 0, shape.Width, greatest);
      }
      if (VY && r >= WindowRadius)
      {
        const std::ptrdiff_t centre = r - WindowRadius;
        const std::ptrdiff_t offset = centre * shape.Pitch;
        FindInWindow(Around<WindowRadius>(m_LeastAlongX, centre),
                     Around<WindowRadius>(m_GreatestAlongX, centre),
                     shape.Width,
                     Keep{ leastOfPlane + offset, greatestOfPlane + offset });
      }
    }
  }

  /** T of the voxels of a row of plane p, which is number i of its step. */
  SUBDIVISION_INLINE void
  FindRow(const Shape &        shape,
          const bool           hasZ,
          const double         tension,
          const std::ptrdiff_t row,
          const std::ptrdiff_t p,
          const int            i)
  {
    const std::ptrdiff_t offset = row * shape.Pitch;
    T * const            limit = m_LimitOfRow[i];
    const auto           factor = Broadcast<T>(4 * tension);
    // In this order nothing overflows before T itself does.
    const auto use = [=, &factor](const std::ptrdiff_t x, const auto least, const auto greatest) SUBDIVISION_ATTRIBUTE {
      Store(ZeroUnlessDivisible(Mul(factor, Mul(least, Div(least, greatest))), greatest), limit + x);
    };
    if (hasZ)
    {
      FindInWindow(
        Around<WindowRadius>(m_Least, p, offset), Around<WindowRadius>(m_Greatest, p, offset), shape.Width, use);
      return;
    }
    const T * const least = m_Least[p] + offset;
    const T * const greatest = m_Greatest[p] + offset;
    for (std::ptrdiff_t x = 0; x < shape.Width; x += LaneCount<T>())
    {
      use(x, Load(least + x), Load(greatest + x));
    }
  }

  SUBDIVISION_INLINE const T *
  GetLimit(const int i) const
  {
    return m_LimitOfRow[i];
  }

private:
  struct Keep
  {
    T * Least;
    T * Greatest;

    SUBDIVISION_INLINE void
    operator()(const std::ptrdiff_t x, const Vector<T> least, const Vector<T> greatest) const
    {
      Store(least, Least + x);
      Store(greatest, Greatest + x);
    }
  };

  /** H of a row, \c offset values into the middle one of three planes. */
  SUBDIVISION_INLINE void
  FindVariation(const Shape & shape, T * const * const planes, const std::ptrdiff_t offset, const bool hasZ)
  {
    constexpr std::ptrdiff_t reach = VX ? WindowRadius : 0;
    const T * const          before = planes[0] + offset;
    const T * const          row = planes[1] + offset;
    const T * const          after = planes[2] + offset;
    T * const                variation = m_Variation;
    const std::ptrdiff_t     pitch = shape.Pitch;
    for (std::ptrdiff_t x = FirstVector<T>(reach); x < shape.Width + reach; x += LaneCount<T>())
    {
      const auto value = KeepInRegister(Load(row + x));
      const auto differ = [=, &value](const T * const one, const T * const other) SUBDIVISION_ATTRIBUTE {
        return Add(Magnitude(Sub(value, Load(one + x))), Magnitude(Sub(Load(other + x), value)));
      };
      auto sum = VX ? differ(row - 1, row + 1) : differ(before, after);
      if constexpr (VY)
      {
        sum = Add(sum, differ(row - pitch, row + pitch));
      }
      if (VX && hasZ)
      {
        sum = Add(sum, differ(before, after));
      }
      Store(ToOrderedBits(sum), variation + x);
    }
  }

  /** Calls \c use with the least and the greatest of windows of five. */
  template <typename TValues, typename TUse>
  static SUBDIVISION_INLINE void
  FindInWindow(const TValues least, const TValues greatest, const std::ptrdiff_t width, const TUse & use)
  {
    for (std::ptrdiff_t x = 0; x < width; x += LaneCount<T>())
    {
      const auto before = MaxNonNegative(greatest(x, -2), greatest(x, -1));
      const auto after = MaxNonNegative(greatest(x, 1), greatest(x, 2));
      use(x, WindowMinimum(least, x), MaxNonNegative(MaxNonNegative(before, after), greatest(x, 0)));
    }
  }

  static constexpr int WindowPlanes = 2 * ValueRadius + PlanesPerStep;

  Ring<T, WindowPlanes>         m_Least;
  Ring<T, WindowPlanes>         m_Greatest;
  Ring<T, 2 * WindowRadius + 1> m_LeastAlongX;
  Ring<T, 2 * WindowRadius + 1> m_GreatestAlongX;
  T *                           m_Variation;
  T *                           m_LimitOfRow[PlanesPerStep];
};

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
