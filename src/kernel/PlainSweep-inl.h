// SPDX-License-Identifier: Apache-2.0

// Linear, bounded linear and B-spline scheme. Included by Sweep-inl.h, once for every target, into its own namespace.

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** \brief Linear, bounded linear and B-spline scheme. */
template <typename T, bool VX, bool VY>
class PlainSweep final : public BasicSweep<T, VX, VY>
{
public:
  explicit PlainSweep(const SweepSettings & settings)
    : BasicSweep<T, VX, VY>(settings)
    , m_IsBounded(settings.Scheme.IsBounded)
    , m_Masks(settings.Scheme.Values == Mask::Linear ? LinearPass : BSplinePass)
    , m_LastMasks(m_IsBounded                              ? m_Masks
                  : settings.Scheme.Values == Mask::Linear ? LinearLastPass
                                                           : BSplineLastPass)
  {
    this->Allocate([this](Layout<T> & layout) {
      m_Passes.Allocate(layout);
      if (m_IsBounded)
      {
        m_Range.Allocate(layout);
      }
    });
  }

protected:
  void
  Advance(const std::ptrdiff_t n) override
  {
    const Shape &   shape = this->m_Shape;
    const T * const plane = this->m_Input[n];
    const auto      row = [plane, pitch = shape.Pitch](int, const std::ptrdiff_t r) { return plane + r * pitch; };
    m_Passes.FilterAlongY(shape, 0, shape.Height, m_Masks, row, row, m_Passes.Values(), n);
    if (m_IsBounded)
    {
      m_Range.Advance(shape, plane, n);
    }
  }

  void
  FilterAlongZ(const std::ptrdiff_t row, const int yChild, const std::ptrdiff_t first, const int planes) override
  {
    m_Passes.FilterAlongZ(this->m_Shape, this->HasZ(), VX ? m_Masks : m_LastMasks, row, yChild, first, planes);
    for (int i = 0; i < planes && m_IsBounded; ++i)
    {
      m_Range.FindRow(this->m_Shape, this->HasZ(), row, first + i, i);
    }
  }

  const T *
  FilterAlongX(const int plane, const int zChild) override
  {
    T * const children = VX ? this->m_Children : m_Passes.GetRow(plane, zChild);
    if constexpr (VX)
    {
      m_Passes.FilterAlongX(this->m_Shape, m_LastMasks, plane, zChild, ChildrenAlongX<T>{ children });
    }
    if (m_IsBounded)
    {
      this->Bound(m_Range.GetLow(plane), m_Range.GetHigh(plane), children);
    }
    return children;
  }

private:
  /** Clamps children to the range of the neighbours of their parents; those that are not finite stay as they are. */
  void
  Bound(const T * const lows, const T * const highs, T * const children) const
  {
    const auto scale = Broadcast<T>(ScaleOfChildren);
    ForEachVectorOfChildren<T, VX>(
      this->m_Shape.Width, [=, &scale](const std::ptrdiff_t child, const std::ptrdiff_t x) SUBDIVISION_ATTRIBUTE {
        const auto value = Load(children + child);
        const auto bounded = OrderedMin(OrderedMax(value, Load(lows + x)), Load(highs + x));
        Store(Mul(scale, IfFinite(value, bounded)), children + child);
      });
  }

  const bool                        m_IsBounded;
  const PassMasks &                 m_Masks;
  const PassMasks &                 m_LastMasks;
  SeparablePasses<T, VX, VY, false> m_Passes;
  LocalRange<T, VX, VY>             m_Range;
};

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
