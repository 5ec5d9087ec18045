// SPDX-License-Identifier: Apache-2.0
#ifndef RunPlan_h
#define RunPlan_h

#include "NonOscillatorySubdivision/Subdivider.h"
#include "array/TileAxes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{
namespace Subdivision
{

/** \brief An axis of a run: one of the arrays' axes, or several that are not subdivided and lie in memory like one.
 *
 * Positions along it are counted from the first parent. */
struct RunAxis
{
  struct Part
  {
    std::size_t   ArrayAxis;
    std::int64_t  First; // the index of position 0
    std::uint64_t Size;
  };

  /** The fastest first; several only where they are not subdivided. */
  std::vector<Part> Parts;
  bool              IsSubdivided;
  /** The number of parents: voxels with children in the output, or elements where the axis is not subdivided. */
  std::uint64_t Parents;
  /** What the output depends on, and the whole input: some positions of the former may lie outside the latter. */
  Interval Stencil;
  Interval Whole;
  /** The first output element, counted from the lower child of the first parent: 0 or 1. */
  std::int64_t  FirstOutput;
  std::uint64_t Outputs;
  /** From an element to the next one, in bytes. */
  std::ptrdiff_t InputStep;
  std::ptrdiff_t OutputStep;

  /** Children of a parent. */
  std::int64_t
  GetChildren() const
  {
    return IsSubdivided ? Children : 1;
  }
};

/** \brief A run in the order of memory: what is read, what is written, and along which axes. */
struct RunPlan
{
  /** \pre CheckArguments() */
  RunPlan(const ConstArrayView & input, const Box & whole, const ArrayView & output, const Options & options);

  /** The elements at position 0 and at the first output of every axis. */
  const unsigned char * Input;
  unsigned char *       Output;
  ElementType           InputType;
  ElementType           OutputType;

  int                         Radius;
  Subdivision::Boundary       Boundary;
  const Subdivision::Target * Target;
  /** The first index of the whole input along the arrays' axis 0, along which constants may differ. */
  std::int64_t FirstConstant;
  /** The number of axes of the arrays. */
  std::size_t ArrayAxes;

  /** x of the tiles first, then those that tiles are cut along, then those that lie within a row. */
  std::vector<RunAxis> Axes;
  std::size_t          CutAxes;

  Flags
  GetSubdividedAxes() const;

  bool
  ComputesInDouble() const
  {
    return NeedsDouble(InputType) || NeedsDouble(OutputType);
  }

  /** The tiles, along the axes that they are cut along. */
  Tiling
  MakeTiling(unsigned int threads) const;

  /** The tile of that number, along all axes. */
  Box
  GetTile(const Tiling & tiling, std::size_t number) const;
};

} // namespace Subdivision
} // namespace itk

#endif
