// SPDX-License-Identifier: Apache-2.0

// The restored scheme. Included by Sweep-inl.h, once for every target, into its own namespace.

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** \brief The restored scheme: E + clamp(A f - E, -T, T), where A f is the linear scheme's child and E the B-spline's
 * of P f, clamped to the local range. */
template <typename T, bool VX, bool VY>
class RestoredSweep final : public BasicSweep<T, VX, VY>
{
public:
  explicit RestoredSweep(const SweepSettings & settings)
    : BasicSweep<T, VX, VY>(settings)
    , m_IsCorrected(settings.Tension > 0)
  {
    this->Allocate([this](Layout<T> & layout) {
      m_Sharpening.Allocate(layout);
      m_Smooth.Allocate(layout);
      m_Linear.Allocate(layout);
      m_Range.Allocate(layout);
      m_Restoration.Allocate(layout);
      m_LinearChildren = layout.TakeChildRow();
    });
  }

protected:
  void
  Advance(const std::ptrdiff_t n) override
  {
    const Shape &        shape = this->m_Shape;
    const bool           hasZ = this->HasZ();
    const std::ptrdiff_t p = hasZ ? n - 2 : n;
    if (p < 0)
    {
      return;
    }
    const auto rowsOf = [pitch = shape.Pitch](const T * const plane) {
      return [=](int, const std::ptrdiff_t r) { return plane + r * pitch; };
    };
    const auto sharpened = rowsOf(m_Sharpening.Advance(shape, this->m_Input, n, hasZ));
    const auto values = rowsOf(this->m_Input[p]);
    m_Smooth.FilterAlongY(shape, 0, shape.Height, BSplinePass, sharpened, sharpened, m_Smooth.Values(), p);
    m_Range.Advance(shape, this->m_Input[p], p);
    if (m_IsCorrected)
    {
      m_Linear.FilterAlongY(shape, 0, shape.Height, LinearPass, values, values, m_Linear.Values(), p);
      m_Restoration.Advance(shape, this->m_Input, p, hasZ);
    }
  }

  void
  FilterAlongZ(const std::ptrdiff_t row, const int yChild, const std::ptrdiff_t first, const int planes) override
  {
    const Shape & shape = this->m_Shape;
    const bool    hasZ = this->HasZ();
    m_Smooth.FilterAlongZ(shape, hasZ, BSplinePass, row, yChild, first, planes);
    for (int i = 0; i < planes; ++i)
    {
      m_Range.FindRow(shape, hasZ, row, first + i, i);
    }
    if (!m_IsCorrected)
    {
      return;
    }
    m_Linear.FilterAlongZ(shape, hasZ, LinearPass, row, yChild, first, planes);
    for (int i = 0; i < planes; ++i)
    {
      m_Restoration.FindRow(shape, hasZ, this->m_Settings.Tension, row, first + i, i);
    }
  }

  const T *
  FilterAlongX(const int plane, const int zChild) override
  {
    if constexpr (VX)
    {
      const Restore restore = this->MakeRestore(plane, m_LinearChildren, this->m_Children);
      if (m_IsCorrected)
      {
        m_Linear.FilterAlongX(this->m_Shape, LinearPass, plane, zChild, ChildrenAlongX<T>{ m_LinearChildren });
      }
      m_Smooth.FilterAlongX(this->m_Shape, BSplinePass, plane, zChild, restore);
      return this->m_Children;
    }
    else
    {
      T * const     smooth = m_Smooth.GetRow(plane, zChild);
      const Restore restore = this->MakeRestore(plane, m_Linear.GetRow(plane, zChild), smooth);
      for (std::ptrdiff_t x = 0; x < this->m_Shape.Width; x += LaneCount<T>())
      {
        restore.StoreChildren(x, x, Load(smooth + x));
      }
      return smooth;
    }
  }

private:
  /** Takes smooth children, vector by vector, and keeps the restored ones. */
  struct Restore
  {
    const T * Linear;
    const T * Low;
    const T * High;
    const T * Limit;
    T *       Restored;

    /** \c child is the place of a vector of children, x that of their parents. Smooth children that are not finite stay
     * so. */
    SUBDIVISION_INLINE void
    StoreChildren(const std::ptrdiff_t child, const std::ptrdiff_t x, const Vector<T> smooth) const
    {
      const auto limit = Load(Limit + x);
      const auto bounded = IfFinite(smooth, OrderedMin(OrderedMax(smooth, Load(Low + x)), Load(High + x)));
      const auto correction = OrderedMin(limit, OrderedMax(Neg(limit), Sub(Load(Linear + child), bounded)));
      Store(Mul(Broadcast<T>(ScaleOfChildren), Add(bounded, correction)), Restored + child);
    }

    SUBDIVISION_INLINE void
    operator()(const std::ptrdiff_t x, const Vector<T> lower, const Vector<T> upper) const
    {
      this->StoreChildren(2 * x, x, lower);
      this->StoreChildren(2 * x + LaneCount<T>(), x, upper);
    }
  };

  Restore
  MakeRestore(const int plane, const T * const linear, T * const restored) const
  {
    return { linear, m_Range.GetLow(plane), m_Range.GetHigh(plane), m_Restoration.GetLimit(plane), restored };
  }

  /** Without a tension T is 0, as the memory of the limits is from the start, and A f is not needed. */
  const bool m_IsCorrected;

  Sharpening<T, VX, VY>             m_Sharpening;
  SeparablePasses<T, VX, VY, false> m_Smooth;
  SeparablePasses<T, VX, VY, false> m_Linear;
  LocalRange<T, VX, VY>             m_Range;
  Restoration<T, VX, VY>            m_Restoration;
  T *                               m_LinearChildren;
};

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
