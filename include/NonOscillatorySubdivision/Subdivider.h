// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_Subdivider_h
#define NonOscillatorySubdivision_Subdivider_h

#include "NonOscillatorySubdivision/ArrayView.h"
#include "NonOscillatorySubdivision/Boundary.h"
#include "NonOscillatorySubdivision/Scheme.h"
#include "NonOscillatorySubdivision/Target.h"
#include "NonOscillatorySubdivision/TileRun.h"
#include "NonOscillatorySubdivision/Tiling.h"
#include "NonOscillatorySubdivisionExport.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace itk
{
namespace Subdivision
{

/** \brief What to compute. */
struct Options
{
  /** One of Schemes; null stands for the first, the non-oscillatory one. */
  const Subdivision::Scheme * Scheme = nullptr;
  double                      Tension = 2.0;
  /** For each axis whether it is subdivided; three at most. */
  Flags                 SubdividedAxes;
  Subdivision::Boundary Boundary = Subdivision::Boundary::Nearest();
  /** Null stands for the fastest. */
  const Subdivision::Target * Target = nullptr;
};

/** \brief Kernels and buffers that are kept from run to run. Used by one Subdivider at a time. */
class NonOscillatorySubdivision_EXPORT Workspace
{
public:
  Workspace();
  ~Workspace();
  Workspace(const Workspace &) = delete;
  Workspace &
  operator=(const Workspace &) = delete;

private:
  friend class Subdivider;
  struct Implementation;
  std::unique_ptr<Implementation> m_Implementation;
};

/** \brief A run from array to array. Computes in double if either element type NeedsDouble(), else in float; where no
 * axis is subdivided and the types are the same, elements are copied exactly.
 *
 * Axes may lie in memory in any order and direction: that of their strides, and of their numbers where these are equal.
 * Rows of tiles run along the axis whose elements lie closest in the input, unless it is as short as the components
 * of pixels; the output is best laid out alike.
 * The bytes of an element depend on the input, its order in memory among it, and the options alone: not on the box
 * asked for, the tiles or the threads. Where axes lie in another order than that of their numbers, one that is not
 * subdivided and has one element in a part needs a stride of its own there. */
class NonOscillatorySubdivision_EXPORT Subdivider : public TileRun
{
public:
  /** The most memory that a Workspace takes for each thread, in bytes; for who plans memory. Tiles do not grow with the
   * arrays. */
  static constexpr std::size_t MostScratchBytesPerThread = std::size_t{ 32 } << 20;

  /** \param input what there is of the input: at least what GetInputRequest() names
   * \param whole the indices of the whole input, beyond which the boundary begins
   * \param output where the results go: its box is what is computed
   * \param threads how many threads will compute tiles at once; for the tiling alone
   * \throw std::invalid_argument if options, sizes or boxes do not fit each other, before anything is computed */
  Subdivider(const ConstArrayView & input,
             const Box &            whole,
             const ArrayView &      output,
             const Options &        options,
             unsigned int           threads,
             Workspace &            workspace);
  ~Subdivider() override;
  Subdivider(const Subdivider &) = delete;
  Subdivider &
  operator=(const Subdivider &) = delete;

  /** The part of the input that the elements of an output box depend on. */
  static Box
  GetInputRequest(const Box & output, const Box & whole, const Options & options);

  /** All of the output.
   * \throw std::overflow_error if it has indices that do not fit 64 bits */
  static Box
  GetWholeOutput(const Box & whole, const Flags & subdivided);

  std::size_t
  GetNumberOfTiles() const override;

  /** May throw what the boundary throws. */
  void
  ComputeTile(std::size_t number, TileMonitor & monitor) override;

private:
  struct Implementation;
  std::unique_ptr<Implementation> m_Implementation;
};

} // namespace Subdivision
} // namespace itk

#endif
