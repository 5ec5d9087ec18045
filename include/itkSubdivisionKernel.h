// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionKernel_h
#define itkSubdivisionKernel_h

#include "NonOscillatorySubdivisionExport.h"
#include "itkNonOscillatorySubdivisionImageFilterEnums.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace itk
{

/** Instruction sets that the kernel was built for and that this processor has, the fastest first. The last one is
 * always "portable". */
NonOscillatorySubdivision_EXPORT std::vector<std::string>
                                 GetSubdivisionTargets();

/** Makes kernels that are constructed from now on use one of GetSubdivisionTargets(); the empty name, the default,
 * stands for the fastest. For tests and benchmarks: results of two targets may differ in the last place.
 * \throw std::invalid_argument if there is no such target. */
NonOscillatorySubdivision_EXPORT void
SetSubdivisionTarget(const std::string & name);

/** The name of the target that kernels constructed now use. */
NonOscillatorySubdivision_EXPORT std::string
                                 GetSubdivisionTarget();

/** \class SubdivisionKernel
 *
 * \brief Subdivides a tile of real values along one, two or three axes: voxels in, children out.
 *
 * The first axis runs along the lanes of a row, the last one along the sweep, from plane to plane; with three axes the
 * one between runs from row to row of a plane. With two axes a plane is a single row, with one axis each row is
 * an image of its own.
 *
 * A tile is computed by a sweep. The caller writes one plane after the other, with GetRadius() more voxels on either
 * side of the tile along every axis, and takes the children of planes as they are completed, some GetRadius() planes
 * later (with one axis: of the row just written):
 *
 * \code
 * kernel.StartTile(width, height, depth);
 * unsigned int complete = 0;
 * for (each plane, from GetRadius() planes before the tile to GetRadius() planes after it)
 * {
 *   for (each row, likewise)
 *     write kernel.GetInputRow(row)[-radius ... width + radius - 1];
 *   complete += kernel.AdvancePlane();
 *   if (complete + 1 >= PlanesPerStep, or this is the last plane)
 *   {
 *     for (row = 0; row < height; ++row)
 *       for (rowChild = 0; rowChild < 2; ++rowChild)
 *       {
 *         kernel.ComputeRow(row, rowChild, complete);
 *         for (age = 0; age < complete; ++age)
 *           for (sweepChild = 0; sweepChild < 2; ++sweepChild)
 *             use kernel.ComputeChildren(age, sweepChild);
 *       }
 *     complete = 0;
 *   }
 * }
 * \endcode
 *
 * What lies outside the image is the caller's to supply; the kernel treats it as data. The children of a voxel are the
 * same bytes wherever the voxel lies in its tile.
 *
 * The real type is float or double. A kernel is used by one thread at a time and allocates in its constructor only.
 *
 * \ingroup NonOscillatorySubdivision
 */
template <typename TReal>
class NonOscillatorySubdivision_EXPORT SubdivisionKernel
{
public:
  using SchemeEnum = NonOscillatorySubdivisionImageFilterEnums::Scheme;

  /** Planes whose children are best computed together, since they share most of what they read. */
  static constexpr unsigned int PlanesPerStep = 6;

  /** A kernel for tiles of at most the given size in voxels.
   * \param scheme the scheme of all tiles
   * \param tension finite and > 1; used by the non-oscillatory scheme only
   * \param numberOfAxes 1, 2 or 3
   * \param maximumWidth voxels along the lanes, without the halo
   * \param maximumHeight rows, without the halo; ignored unless there are three axes */
  SubdivisionKernel(SchemeEnum   scheme,
                    double       tension,
                    unsigned int numberOfAxes,
                    std::size_t  maximumWidth,
                    std::size_t  maximumHeight);
  ~SubdivisionKernel();
  SubdivisionKernel(const SubdivisionKernel &) = delete;
  SubdivisionKernel &
  operator=(const SubdivisionKernel &) = delete;

  /** Voxels that a scheme reads on either side of a voxel along each subdivided axis. */
  static unsigned int
  GetRadius(SchemeEnum scheme);

  /** The largest tiles, width by height, that are computed efficiently. Heights apply with three axes only. */
  static void
  GetRecommendedTileSize(unsigned int numberOfAxes, std::size_t & width, std::size_t & height);

  /** Begins a tile of \c width voxels along the lanes, \c height rows and \c depth planes, without the halo. */
  void
  StartTile(std::size_t width, std::size_t height, std::size_t depth);

  /** Where voxel 0 of a row of the next plane is to be written; the halo lies before and after it. */
  TReal *
  GetInputRow(std::ptrdiff_t row);

  /** Takes the plane that was written. Returns of how many planes it completed the children: 0, 1 or 2. */
  unsigned int
  AdvancePlane();

  /** Begins the children of one row in the planes that were completed last.
   * \param row the row of the voxels
   * \param rowChild the child from row to row, 0 or 1; 0 unless there are three axes
   * \param planes the number of planes, 1 to PlanesPerStep */
  void
  ComputeRow(std::size_t row, unsigned int rowChild, unsigned int planes);

  /** Both children along the lanes of every voxel of that row in one plane, in the order that InterleaveChildren takes.
   * They last until the next call.
   * \param age the number of planes completed since
   * \param sweepChild the child from plane to plane, 0 or 1; 0 without a sweep */
  const TReal *
  ComputeChildren(unsigned int age, unsigned int sweepChild);

private:
  struct Implementation;
  std::unique_ptr<Implementation> m_Implementation;
};

/** Pixels that are converted from and to float in vector code: 8- and 16-bit integers and float.
 *
 * \c ConvertRow widens \c count pixels. \c InterleaveChildren makes the 2 \c count pixels of a row of the kernel's
 * children, lower, upper, lower, ...; integers are rounded to nearest, ties to even, and saturate, and NaN becomes 0.
 * @{ */
#define itkDeclareSubdivisionConversions(TPixel)                                                       \
  NonOscillatorySubdivision_EXPORT void ConvertRow(const TPixel * in, std::size_t count, float * out); \
  NonOscillatorySubdivision_EXPORT void InterleaveChildren(const float * children, std::size_t count, TPixel * out)
itkDeclareSubdivisionConversions(std::uint8_t);
itkDeclareSubdivisionConversions(std::int8_t);
itkDeclareSubdivisionConversions(std::uint16_t);
itkDeclareSubdivisionConversions(std::int16_t);
itkDeclareSubdivisionConversions(float);
#undef itkDeclareSubdivisionConversions
NonOscillatorySubdivision_EXPORT void
InterleaveChildren(const double * children, std::size_t count, double * out);
/** @} */

extern template class SubdivisionKernel<float>;
extern template class SubdivisionKernel<double>;

} // namespace itk

#endif
