// SPDX-License-Identifier: Apache-2.0

// The non-oscillatory scheme. Included by Sweep-inl.h, once for every target, into its own namespace.

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** \brief The non-oscillatory scheme: the B-spline of the values and limited second differences. */
template <typename T, bool VX, bool VY>
class LimitedSweep final : public BasicSweep<T, VX, VY>
{
public:
  explicit LimitedSweep(const SweepSettings & settings)
    : BasicSweep<T, VX, VY>(settings)
  {
    this->Allocate([this](Layout<T> & layout) {
      m_InPlane.Allocate(layout);
      m_AlongZ.Allocate(layout);
      m_Passes.Allocate(layout);
    });
  }

protected:
  /** Differences along z are computed for two planes at a time, of which the last plane of a tile completes a pair; if
   * their number is odd, the first one does so, too. */
  bool
  IsComplete(const std::ptrdiff_t n) const override
  {
    return !this->HasZ() || (this->m_Last - n) % 2 == 0;
  }

  void
  Advance(const std::ptrdiff_t n) override
  {
    if (!this->HasZ())
    {
      this->AdvanceInPlane(n);
      return;
    }
    // The first planes only fill the rings; what would be computed from them is not used.
    if (n - WindowRadius >= NeededPlane)
    {
      this->AdvanceInPlane(n - WindowRadius);
    }
    if (this->IsComplete(n))
    {
      this->AdvanceAlongZ(n);
    }
  }

  void
  FilterAlongZ(const std::ptrdiff_t row, const int yChild, const std::ptrdiff_t first, const int planes) override
  {
    m_Passes.FilterAlongZ(this->m_Shape, this->HasZ(), VX ? BSplinePass : BSplineLastPass, row, yChild, first, planes);
  }

  const T *
  FilterAlongX(const int plane, const int zChild) override
  {
    if constexpr (!VX)
    {
      return m_Passes.GetRow(plane, zChild);
    }
    else
    {
      m_Passes.FilterAlongX(this->m_Shape, BSplineLastPass, plane, zChild, ChildrenAlongX<T>{ this->m_Children });
      return this->m_Children;
    }
  }

private:
  /** The first plane that children read themselves, not only by way of variations. */
  static constexpr std::ptrdiff_t NeededPlane = WindowRadius + 1 + SecondDifferenceRadius - ValueRadius;

  /** Limits some rows and then filters them, until all are done: either step finds in the cache what it keeps. */
  template <typename TLimit, typename TFilter>
  SUBDIVISION_INLINE void
  ForEachBlock(const TLimit & limit, const TFilter & filter)
  {
    constexpr std::ptrdiff_t rowsPerBlock = LimitedRows<T>::RowsPerBlock;
    // The first row is there for the differences between it and the next one only.
    const std::ptrdiff_t end = VY ? this->m_Shape.Height + VariationReach : 1;
    for (std::ptrdiff_t begin = VY ? -VariationReach - 1 : 0; begin < end; begin += rowsPerBlock)
    {
      const std::ptrdiff_t blockEnd = std::min<std::ptrdiff_t>(begin + rowsPerBlock, end);
      for (std::ptrdiff_t r = begin; r < blockEnd; ++r)
      {
        limit(r);
      }
      filter(std::max<std::ptrdiff_t>(begin - VariationReach, 0), blockEnd - VariationReach);
    }
  }

  void
  AdvanceInPlane(const std::ptrdiff_t p)
  {
    const Shape     shape = this->m_Shape;
    const double    tension = this->m_Settings.Tension;
    const T * const plane = this->m_Input[p];
    const auto      limit = [&](const std::ptrdiff_t r)
                         SUBDIVISION_ATTRIBUTE { m_InPlane.Advance(shape, plane, r, tension); };
    const auto values = [&](const int term, const std::ptrdiff_t r) SUBDIVISION_ATTRIBUTE {
      return term == 0 ? plane + r * shape.Pitch : m_InPlane.GetRow(XAxis, r);
    };
    const auto differences = [&](const int term, const std::ptrdiff_t r)
                               SUBDIVISION_ATTRIBUTE { return m_InPlane.GetRow(term | YAxis, r); };
    this->ForEachBlock(limit, [&](const std::ptrdiff_t begin, const std::ptrdiff_t end) SUBDIVISION_ATTRIBUTE {
      m_Passes.FilterAlongY(shape, begin, end, BSplinePass, values, differences, m_Passes.Values(), p);
    });
  }

  void
  AdvanceAlongZ(const std::ptrdiff_t n)
  {
    const Shape  shape = this->m_Shape;
    const double tension = this->m_Settings.Tension;
    if constexpr (VY)
    {
      m_AlongZ.AdvanceAlongZ(shape, this->m_Input, n, -VariationReach - 1, tension);
    }
    const auto limit = [&](const std::ptrdiff_t r) SUBDIVISION_ATTRIBUTE {
      m_AlongZ.AdvanceAlongZ(shape, this->m_Input, n, VY ? r + 1 : r, tension);
      m_AlongZ.Advance(shape, n, r, tension);
    };
    const bool areWindowsComplete = n >= 2 * WindowRadius + 2;
    this->ForEachBlock(limit, [&](const std::ptrdiff_t begin, const std::ptrdiff_t end) SUBDIVISION_ATTRIBUTE {
      for (int plane = 0; plane < 2 && areWindowsComplete; ++plane)
      {
        const auto values = [&](const int term, const std::ptrdiff_t r)
                              SUBDIVISION_ATTRIBUTE { return m_AlongZ.GetRow(plane, term, r); };
        const auto differences = [&](const int term, const std::ptrdiff_t r)
                                   SUBDIVISION_ATTRIBUTE { return m_AlongZ.GetRow(plane, term | YAxis, r); };
        m_Passes.FilterAlongY(
          shape, begin, end, BSplinePass, values, differences, m_Passes.Differences(), n - 2 * WindowRadius + plane);
      }
    });
  }

  InPlaneDifferences<T, VX, VY>    m_InPlane;
  SweepDifferences<T, VX, VY>      m_AlongZ;
  SeparablePasses<T, VX, VY, true> m_Passes;
};

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
