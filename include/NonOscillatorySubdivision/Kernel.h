// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_Kernel_h
#define NonOscillatorySubdivision_Kernel_h

#include "NonOscillatorySubdivision/ElementType.h"
#include "NonOscillatorySubdivision/Scheme.h"
#include "NonOscillatorySubdivision/Target.h"
#include "NonOscillatorySubdivisionExport.h"

#include <array>
#include <cstddef>
#include <memory>

namespace itk
{
namespace Subdivision
{

/** \brief A kernel's input: voxels -R ... width + R - 1 of row y of plane z (R: the scheme's radius), all counted from
 * the tile's first voxel. y and z reach R beyond the tile along axes that are subdivided; x does so only if it is. */
template <typename TReal>
class RowSource
{
public:
  virtual ~RowSource() = default;
  virtual void
  ReadRow(std::ptrdiff_t y, std::ptrdiff_t z, TReal * values) = 0;
};

/** \brief A row of children, in an order of its own: the one way to have them as elements. */
template <typename TReal>
class NonOscillatorySubdivision_EXPORT ChildRow
{
public:
  /** For the kernel. */
  ChildRow(const TReal * values, std::size_t size, bool isInterleaved, const Target & target)
    : m_Values(values)
    , m_Size(size)
    , m_IsInterleaved(isInterleaved)
    , m_Target(&target)
  {}

  /** The number of children. */
  std::size_t
  GetSize() const;

  /** In order, side by side. Integers round to nearest, ties to even, and saturate; NaN becomes 0. Real values are
   * neither rounded nor clamped, but double becomes float where that is the type. */
  void
  CopyTo(ElementType type, void * elements) const;

private:
  const TReal *  m_Values;
  std::size_t    m_Size;
  bool           m_IsInterleaved;
  const Target * m_Target;
};

/** \brief A kernel's output: row y of plane z of the tile's children, counted from the first child of the tile's first
 * voxel. The row lasts for the call. Rows come in any order, each of them once. */
template <typename TReal>
class RowSink
{
public:
  virtual ~RowSink() = default;
  virtual void
  WriteRow(std::ptrdiff_t y, std::ptrdiff_t z, const ChildRow<TReal> & children) = 0;
};

/** The size of a tile, in voxels, without the halo. */
struct TileSize
{
  std::size_t X;
  std::size_t Y;
  std::size_t Z;
};

/** Which axes of a tile are subdivided. */
struct Axes
{
  bool X;
  bool Y;
  bool Z;
};

/** \brief Subdivides a tile of real values along one, two or three axes: asks for rows, hands over rows of children.
 *
 * x runs along the rows, y from row to row of a plane, z from plane to plane. An axis that is not subdivided is
 * carried: its rows, or positions in a row, are images of their own, and come back as they are many. Any set of axes
 * does, and a tile has any size along each of them; if rows are many along an axis that is carried, image after image
 * is computed. What lies outside the image is the source's to supply; the kernel treats it as data. The children of a
 * voxel are the same bytes wherever the voxel lies in its tile.
 *
 * Finite voxels of at most a quarter of the largest value have finite children. Voxels are scaled by 2^-8 on the way,
 * so what lies below 2^8 times the smallest normal value has fewer digits. Children whose stencil holds no voxel that
 * is not finite are the same bytes as without it.
 *
 * The real type is float or double. A kernel is used by one thread at a time and allocates in its constructor only.
 * After an exception from a source or a sink it can be used again. */
template <typename TReal>
class NonOscillatorySubdivision_EXPORT Kernel
{
public:
  /** A kernel for tiles of at most the given size.
   * \param scheme one of Schemes
   * \param tension see CheckTension()
   * \param subdivided at least one axis
   * \param largest the largest tile; none of its sizes is 0
   * \throw std::invalid_argument */
  Kernel(const Scheme &   scheme,
         double           tension,
         const Axes &     subdivided,
         const TileSize & largest,
         const Target &   target = Target::Fastest());
  ~Kernel();
  Kernel(const Kernel &) = delete;
  Kernel &
  operator=(const Kernel &) = delete;

  /** \throw std::invalid_argument before anything is read, if the tile is larger than what the kernel was made for */
  void
  Subdivide(const TileSize & tile, RowSource<TReal> & source, RowSink<TReal> & sink);

private:
  struct Implementation;
  std::unique_ptr<Implementation> m_Implementation;
};

extern template class Kernel<float>;
extern template class Kernel<double>;
extern template class ChildRow<float>;
extern template class ChildRow<double>;

} // namespace Subdivision
} // namespace itk

#endif
