// SPDX-License-Identifier: Apache-2.0

// The sharpened values of the restored scheme (docs/scheme.md, section 4). No include guard: every target includes this
// file once, into its own namespace.

#include "kernel/stages/Rows-inl.h"

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** \brief Stage: P f = f - 15/16 L f - 9/64 L L f, where L is the sum of the second differences along the subdivided
 * axes. */
template <typename T, bool VX, bool VY>
class Sharpening
{
public:
  void
  Allocate(Layout<T> & layout)
  {
    m_Laplacian.AllocatePlanes(layout);
    m_Sharpened = layout.TakePlane();
  }

  /** Takes plane n of the values, f, and returns P f of plane n - 2, of which those before are known by then; along z
   * it is of use once there are five planes. Without z, P f of plane n. */
  template <typename TInput>
  const T *
  Advance(const Shape & shape, const TInput & input, const std::ptrdiff_t n, const bool hasZ)
  {
    const std::ptrdiff_t q = hasZ ? n - 1 : n;
    T * const            laplacian = m_Laplacian.Begin(q);
    Laplace(shape,
            hasZ,
            ValueRadius + 1,
            input.FromAny(q - 1),
            [=](const std::ptrdiff_t at, const auto sum) SUBDIVISION_ATTRIBUTE { Store(sum, laplacian + at); });

    const std::ptrdiff_t p = hasZ ? n - 2 : n;
    const T * const      f = *input.FromAny(p);
    const T * const      lf = *m_Laplacian.FromAny(p);
    T * const            sharpened = m_Sharpened;
    const auto           weight = Broadcast<T>(-15.0 / 16);
    const auto           weightOfSquare = Broadcast<T>(-9.0 / 64);
    Laplace(shape,
            hasZ,
            ValueRadius,
            m_Laplacian.FromAny(p - 1),
            [=, &weight, &weightOfSquare](const std::ptrdiff_t at, const auto llf) SUBDIVISION_ATTRIBUTE {
              Store(MulAdd(weightOfSquare, llf, MulAdd(weight, Load(lf + at), Load(f + at))), sharpened + at);
            });
    return m_Sharpened;
  }

private:
  /** Calls \c use with the place and L of each vector of a plane: the middle one of three, where there is z. */
  template <typename TUse>
  static SUBDIVISION_INLINE void
  Laplace(const Shape & shape, const bool hasZ, const std::ptrdiff_t reach, T * const * const planes, const TUse & use)
  {
    const auto           centre = Broadcast<T>(2 * ((VX ? 1 : 0) + (VY ? 1 : 0) + (hasZ ? 1 : 0)));
    const T * const      before = planes[0];
    const T * const      plane = planes[1];
    const T * const      after = planes[2];
    const std::ptrdiff_t pitch = shape.Pitch;
    const std::ptrdiff_t reachX = VX ? reach : 0;
    for (std::ptrdiff_t r = VY ? -reach : 0; r < (VY ? shape.Height + reach : 1); ++r)
    {
      const std::ptrdiff_t row = r * pitch;
      for (std::ptrdiff_t x = FirstVector<T>(reachX); x < shape.Width + reachX; x += LaneCount<T>())
      {
        const std::ptrdiff_t at = row + x;
        if constexpr (VX)
        {
          const Neighbours<T, 1> value(plane + at);
          auto                   sum = Add(value.template At<-1>(), value.template At<1>());
          sum = AddNeighbours(sum, hasZ, plane + at, before + at, after + at, pitch);
          use(at, NegMulAdd(centre, value.template At<0>(), sum));
        }
        else
        {
          auto sum = Add(Load(before + at), Load(after + at));
          if constexpr (VY)
          {
            sum = Add(sum, Add(Load(plane + at - pitch), Load(plane + at + pitch)));
          }
          use(at, NegMulAdd(centre, Load(plane + at), sum));
        }
      }
    }
  }

  /** Adds the neighbours along y and z. */
  template <typename TVector>
  static SUBDIVISION_INLINE TVector
  AddNeighbours(TVector              sum,
                const bool           hasZ,
                const T * const      at,
                const T * const      before,
                const T * const      after,
                const std::ptrdiff_t pitch)
  {
    if constexpr (VY)
    {
      sum = Add(sum, Add(Load(at - pitch), Load(at + pitch)));
    }
    return hasZ ? Add(sum, Add(Load(before), Load(after))) : sum;
  }

  Ring<T, 3> m_Laplacian;
  T *        m_Sharpened;
};

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
