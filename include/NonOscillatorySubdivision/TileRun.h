// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_TileRun_h
#define NonOscillatorySubdivision_TileRun_h

#include "NonOscillatorySubdivisionExport.h"

#include <cstddef>

namespace itk
{
namespace Subdivision
{

/** \brief Told of what is done, and asked whether to go on, by every thread that computes tiles. */
class NonOscillatorySubdivision_EXPORT TileMonitor
{
public:
  virtual ~TileMonitor();

  /** Output elements were written. */
  virtual void
  Completed(std::size_t elements) = 0;

  /** Asked before a tile; where it says so, the tile is not computed. */
  virtual bool
  IsStopped() const = 0;

  /** Whether it wants to know what elements of an integer type could not hold. It costs little; by default, no. */
  virtual bool
  CountsLosses() const;

  /** What was computed for so many elements was not a number, so that they are 0, or beyond their type's range, so that
   * they are its least or greatest number. */
  virtual void
  Lost(std::size_t notANumber, std::size_t clamped);
};

/** \brief A run from array to array, tile by tile. */
class NonOscillatorySubdivision_EXPORT TileRun
{
public:
  virtual ~TileRun();

  virtual std::size_t
  GetNumberOfTiles() const = 0;

  /** From any thread, each tile once, in any order; under DefaultFloatingPoint. May throw; then the tile is
   * incomplete. */
  virtual void
  ComputeTile(std::size_t number, TileMonitor & monitor) = 0;
};

} // namespace Subdivision
} // namespace itk

#endif
