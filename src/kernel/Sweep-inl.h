// SPDX-License-Identifier: Apache-2.0

// The loop over a tile's planes, and what the kinds of schemes do in it. No include guard: every target includes this
// file once, into its own namespace.

#include "kernel/stages/InPlaneDifferences-inl.h"
#include "kernel/stages/LocalRange-inl.h"
#include "kernel/stages/Restoration-inl.h"
#include "kernel/stages/SeparablePasses-inl.h"
#include "kernel/stages/Sharpening-inl.h"
#include "kernel/stages/SweepDifferences-inl.h"

#include <algorithm>

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** \brief The loop, which all schemes share: reads a plane, advances the stages by it, and now and then writes the
 * children of those planes that are complete.
 *
 * Planes are counted from the first one of the halo. Plane p is complete once plane p + R is read. */
template <typename T, bool VX, bool VY>
class BasicSweep : public Sweep<T>
{
public:
  explicit BasicSweep(const SweepSettings & settings)
    : m_Settings(settings)
    , m_Radius(settings.Scheme.Radius())
    , m_Layout(MakeLayoutSize(settings))
  {
    m_Shape.Pitch = m_Layout.GetPitch();
  }

  void
  Subdivide(const TileSize & tile, RowSource<T> & source, RowSink<T> & sink) final
  {
    const std::ptrdiff_t halo = this->HasZ() ? m_Radius : 0;
    m_Shape.Width = static_cast<std::ptrdiff_t>(tile.X);
    m_Shape.Height = VY ? static_cast<std::ptrdiff_t>(tile.Y) : 1;
    m_Last = (this->HasZ() ? static_cast<std::ptrdiff_t>(tile.Z) : 1) + 2 * halo - 1;
    std::ptrdiff_t written = halo;
    for (std::ptrdiff_t n = 0; n <= m_Last; ++n)
    {
      this->Read(n, source);
      this->Advance(n);
      const std::ptrdiff_t complete = n + 1 - halo;
      const auto           planes = static_cast<int>(complete - written);
      if (planes > 0 && this->IsComplete(n) && (planes + 1 >= PlanesPerStep || n == m_Last))
      {
        this->Write(written, planes, sink);
        written = complete;
      }
    }
  }

protected:
  /** Advances the stages by plane n. */
  virtual void
  Advance(std::ptrdiff_t n) = 0;

  /** Whether the children of plane n - R are known once plane n is. */
  virtual bool
  IsComplete(std::ptrdiff_t) const
  {
    return true;
  }

  /** Children along z of a row of children along y, in some planes. */
  virtual void
  FilterAlongZ(std::ptrdiff_t row, int yChild, std::ptrdiff_t first, int planes) = 0;

  /** Children along x of one of these rows. */
  virtual const T *
  FilterAlongX(int plane, int zChild) = 0;

  bool
  HasZ() const
  {
    return m_Settings.Subdivided.Z;
  }

  /** Gives the stages their memory: \c allocate is called with the layout, first to count. */
  template <typename TAllocate>
  void
  Allocate(const TAllocate & allocate)
  {
    for (const bool isCounting : { true, false })
    {
      m_Input.AllocatePlanes(m_Layout);
      m_Children = m_Layout.TakeChildRow();
      allocate(m_Layout);
      if (isCounting)
      {
        m_Layout.Allocate();
      }
    }
  }

  /** The planes that the second differences along z read. */
  static constexpr int InputPlanes = 2 * VariationReach - 2;

  const SweepSettings  m_Settings;
  const std::ptrdiff_t m_Radius;
  Shape                m_Shape;
  std::ptrdiff_t       m_Last;
  Ring<T, InputPlanes> m_Input;
  /** One row of children: a vector of lower ones and a vector of upper ones in turns. */
  T * m_Children;

private:
  static LayoutSize
  MakeLayoutSize(const SweepSettings & settings)
  {
    const auto radius = static_cast<std::size_t>(settings.Scheme.Radius());
    // Variations are computed one row further, for the differences between that and the next one only.
    return { settings.LargestWidth,
             settings.LargestHeight,
             radius,
             VY ? radius + 1 : 0,
             static_cast<std::size_t>(LaneCount<T>()) * sizeof(T) };
  }

  void
  Read(const std::ptrdiff_t n, RowSource<T> & source)
  {
    const std::ptrdiff_t reachX = VX ? m_Radius : 0;
    const std::ptrdiff_t reachY = VY ? m_Radius : 0;
    T * const            plane = m_Input.Begin(n);
    for (std::ptrdiff_t y = -reachY; y < m_Shape.Height + reachY; ++y)
    {
      T * const row = plane + y * m_Shape.Pitch;
      source.ReadRow(y, this->HasZ() ? n - m_Radius : 0, row - reachX);
      ScaleRow(ScaleOfVoxels, reachX, m_Shape.Width, row);
    }
  }

  void
  Write(const std::ptrdiff_t first, const int planes, RowSink<T> & sink)
  {
    constexpr int        yChildren = VY ? Children : 1;
    const int            zChildren = this->HasZ() ? Children : 1;
    const std::ptrdiff_t z = this->HasZ() ? first - m_Radius : 0;
    const auto           size = static_cast<std::size_t>(m_Shape.Width) * (VX ? Children : 1);
    for (std::ptrdiff_t y = 0; y < m_Shape.Height; ++y)
    {
      for (int yChild = 0; yChild < yChildren; ++yChild)
      {
        this->FilterAlongZ(y, yChild, first, planes);
        for (int plane = 0; plane < planes; ++plane)
        {
          for (int zChild = 0; zChild < zChildren; ++zChild)
          {
            const ChildRow<T> children(this->FilterAlongX(plane, zChild), size, VX, *m_Settings.Target);
            sink.WriteRow(yChildren * y + yChild, zChildren * (z + plane) + zChild, children);
          }
        }
      }
    }
  }

  Layout<T> m_Layout;
};

/** Calls \c use with each vector of children in a row, by its place, and with the place of their parents. */
template <typename T, bool VX, typename TUse>
SUBDIVISION_INLINE void
ForEachVectorOfChildren(const std::ptrdiff_t width, const TUse & use)
{
  for (std::ptrdiff_t x = 0; x < width; x += LaneCount<T>())
  {
    if constexpr (VX)
    {
      use(2 * x, x);
      use(2 * x + LaneCount<T>(), x);
    }
    else
    {
      use(x, x);
    }
  }
}

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
      this->m_Shape.Width, [=](const std::ptrdiff_t child, const std::ptrdiff_t x) SUBDIVISION_ATTRIBUTE {
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
    // The first planes only fill the rings; what would be computed from them is not used.
    constexpr std::ptrdiff_t outermost = this->NeededPlane;
    if (!this->HasZ())
    {
      this->AdvanceInPlane(n);
      return;
    }
    if (n - WindowRadius >= outermost)
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

/** \brief The restored scheme: E + clamp(A f - E, -T, T), where A f is the linear scheme's child and E the B-spline's
 * of P f, clamped to the local range. */
template <typename T, bool VX, bool VY>
class RestoredSweep final : public BasicSweep<T, VX, VY>
{
public:
  explicit RestoredSweep(const SweepSettings & settings)
    : BasicSweep<T, VX, VY>(settings)
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
    m_Linear.FilterAlongY(shape, 0, shape.Height, LinearPass, values, values, m_Linear.Values(), p);
    m_Range.Advance(shape, this->m_Input[p], p);
    m_Restoration.Advance(shape, this->m_Input, p, hasZ);
  }

  void
  FilterAlongZ(const std::ptrdiff_t row, const int yChild, const std::ptrdiff_t first, const int planes) override
  {
    const Shape & shape = this->m_Shape;
    const bool    hasZ = this->HasZ();
    m_Smooth.FilterAlongZ(shape, hasZ, BSplinePass, row, yChild, first, planes);
    m_Linear.FilterAlongZ(shape, hasZ, LinearPass, row, yChild, first, planes);
    for (int i = 0; i < planes; ++i)
    {
      m_Range.FindRow(shape, hasZ, row, first + i, i);
      m_Restoration.FindRow(shape, hasZ, this->m_Settings.Tension, row, first + i, i);
    }
  }

  const T *
  FilterAlongX(const int plane, const int zChild) override
  {
    if constexpr (VX)
    {
      const Restore restore = this->MakeRestore(plane, m_LinearChildren, this->m_Children);
      m_Linear.FilterAlongX(this->m_Shape, LinearPass, plane, zChild, ChildrenAlongX<T>{ m_LinearChildren });
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

  Sharpening<T, VX, VY>             m_Sharpening;
  SeparablePasses<T, VX, VY, false> m_Smooth;
  SeparablePasses<T, VX, VY, false> m_Linear;
  LocalRange<T, VX, VY>             m_Range;
  Restoration<T, VX, VY>            m_Restoration;
  T *                               m_LinearChildren;
};

template <template <typename, bool, bool> class TSweep, typename T>
Sweep<T> *
MakeForAxes(const SweepSettings & settings)
{
  if (settings.Subdivided.X)
  {
    return settings.Subdivided.Y ? static_cast<Sweep<T> *>(new TSweep<T, true, true>(settings))
                                 : new TSweep<T, true, false>(settings);
  }
  return settings.Subdivided.Y ? static_cast<Sweep<T> *>(new TSweep<T, false, true>(settings))
                               : new TSweep<T, false, false>(settings);
}

template <typename T>
Sweep<T> *
MakeSweep(const SweepSettings & settings)
{
  switch (settings.Scheme.Limited)
  {
    case Correction::SecondDifferences:
      return MakeForAxes<LimitedSweep, T>(settings);
    case Correction::TowardsLinear:
      return MakeForAxes<RestoredSweep, T>(settings);
    default:
      return MakeForAxes<PlainSweep, T>(settings);
  }
}

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
