// SPDX-License-Identifier: Apache-2.0

// The loop over the planes of a tile. Included by Sweep-inl.h, once for every target, into its own namespace.

#include "kernel/stages/Rows-inl.h"

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

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
