// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/Kernel.h"

#include "kernel/Sweep.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>

namespace itk
{
namespace Subdivision
{
namespace
{

/** \brief The rows of one image of a tile, as a sweep counts them: its z is the tile's y where only that is subdivided,
 * and along the axes that are not, the image has a place of its own. */
template <typename TReal>
class ImageRows final
  : public RowSource<TReal>
  , public RowSink<TReal>
{
public:
  ImageRows(const Axes & subdivided, RowSource<TReal> & source, RowSink<TReal> & sink)
    : m_Subdivided(subdivided)
    , m_Source(source)
    , m_Sink(sink)
  {}

  void
  GoTo(const std::ptrdiff_t y, const std::ptrdiff_t z)
  {
    m_Y = y;
    m_Z = z;
  }

  void
  ReadRow(const std::ptrdiff_t y, const std::ptrdiff_t z, TReal * values) override
  {
    m_Source.ReadRow(this->TileY(y, z), this->TileZ(z), values);
  }

  void
  WriteRow(const std::ptrdiff_t y, const std::ptrdiff_t z, const ChildRow<TReal> & children) override
  {
    m_Sink.WriteRow(this->TileY(y, z), this->TileZ(z), children);
  }

private:
  std::ptrdiff_t
  TileY(const std::ptrdiff_t y, const std::ptrdiff_t z) const
  {
    return !m_Subdivided.Y ? m_Y : m_Subdivided.Z ? y : z;
  }

  std::ptrdiff_t
  TileZ(const std::ptrdiff_t z) const
  {
    return m_Subdivided.Z ? z : m_Z;
  }

  const Axes         m_Subdivided;
  RowSource<TReal> & m_Source;
  RowSink<TReal> &   m_Sink;
  std::ptrdiff_t     m_Y{ 0 };
  std::ptrdiff_t     m_Z{ 0 };
};

void
CheckSizes(const TileSize & tile, const TileSize & largest)
{
  if (tile.X == 0 || tile.Y == 0 || tile.Z == 0)
  {
    throw std::invalid_argument("a tile is empty");
  }
  if (tile.X > largest.X || tile.Y > largest.Y || tile.Z > largest.Z)
  {
    throw std::invalid_argument("a tile is larger than what its kernel was made for");
  }
}

template <typename TReal>
SweepSettings
MakeSettings(const Scheme &   scheme,
             const double     tension,
             const Axes &     subdivided,
             const TileSize & largest,
             const Target &   target)
{
  CheckTension(scheme, tension);
  CheckSizes(largest, largest);
  if (!subdivided.X && !subdivided.Y && !subdivided.Z)
  {
    throw std::invalid_argument("a kernel subdivides along at least one axis");
  }
  const bool hasY = subdivided.Y && subdivided.Z;
  const Axes axes{ subdivided.X, hasY, subdivided.Y || subdivided.Z };
  // A sweep has a hundred planes with their halo: no memory holds larger ones, and their sizes in bytes could overflow.
  constexpr std::uint64_t most =
    std::min<std::uint64_t>(std::uint64_t{ 1 } << 40, std::numeric_limits<std::size_t>::max() / 4096);
  const std::size_t height = hasY ? largest.Y : 1;
  if (largest.X > most || height > most || height + 8 > most / (largest.X + 64))
  {
    throw std::invalid_argument("a kernel's largest tile has too many voxels in a plane");
  }
  // An infinite product with a threshold of 0 would not be 0. The restored scheme multiplies by 4 times the tension.
  const int    factor = scheme.Limited == Correction::TowardsLinear ? 4 : 1;
  const double finite = std::min<double>(tension, std::numeric_limits<TReal>::max() / factor);
  return { scheme, finite, axes, largest.X, height, &target };
}

} // namespace

template <typename TReal>
struct Kernel<TReal>::Implementation
{
  Axes                          Subdivided;
  TileSize                      Largest;
  std::unique_ptr<Sweep<TReal>> TileSweep;
};

template <typename TReal>
Kernel<TReal>::Kernel(const Scheme &   scheme,
                      const double     tension,
                      const Axes &     subdivided,
                      const TileSize & largest,
                      const Target &   target)
{
  const SweepSettings           settings = MakeSettings<TReal>(scheme, tension, subdivided, largest, target);
  std::unique_ptr<Sweep<TReal>> sweep(target.GetTable().template Get<TReal>().MakeSweep(settings));
  m_Implementation.reset(new Implementation{ subdivided, largest, std::move(sweep) });
}

template <typename TReal>
Kernel<TReal>::~Kernel() = default;

template <typename TReal>
void
Kernel<TReal>::Subdivide(const TileSize & tile, RowSource<TReal> & source, RowSink<TReal> & sink)
{
  CheckSizes(tile, m_Implementation->Largest);
  const Axes &   axes = m_Implementation->Subdivided;
  Sweep<TReal> & sweep = *m_Implementation->TileSweep;
  const TileSize image{ tile.X, axes.Y && axes.Z ? tile.Y : 1, axes.Z ? tile.Z : axes.Y ? tile.Y : 1 };
  const TileSize images{ 1, axes.Y ? 1 : tile.Y, axes.Z ? 1 : tile.Z };
  if (images.Y == 1 && axes.Z)
  {
    sweep.Subdivide(image, source, sink);
    return;
  }
  ImageRows<TReal> rows(axes, source, sink);
  for (std::size_t z = 0; z < images.Z; ++z)
  {
    for (std::size_t y = 0; y < images.Y; ++y)
    {
      rows.GoTo(static_cast<std::ptrdiff_t>(y), static_cast<std::ptrdiff_t>(z));
      sweep.Subdivide(image, rows, rows);
    }
  }
}

template <typename TReal>
std::size_t
ChildRow<TReal>::GetSize() const
{
  return m_Size;
}

template <typename TReal>
void
ChildRow<TReal>::CopyTo(const ElementType type, void * const elements) const
{
  const TargetFunctions<TReal> & functions = m_Target->GetTable().template Get<TReal>();
  if (m_IsInterleaved)
  {
    ForType(functions.InterleaveChildren, type)(m_Values, m_Size / Children, elements);
  }
  else
  {
    ForType(functions.Narrow, type)(m_Values, m_Size, elements);
  }
}

template class Kernel<float>;
template class Kernel<double>;
template class ChildRow<float>;
template class ChildRow<double>;

} // namespace Subdivision
} // namespace itk
