// SPDX-License-Identifier: Apache-2.0
#include "Pieces.h"

#include <algorithm>
#include <fstream>

#include <unistd.h>

namespace
{
/** A piece has at least a plane, or a row where there is only one plane. */
unsigned int
GetFirstSplitAxis(const ImageRegion & whole)
{
  return whole.GetSize(2) * whole.GetSize(3) > 1 ? 2 : 1;
}

/** The size of a piece: some of one axis, all of the axes before it, one of those after it. */
ImageRegion::SizeType
GetPieceSize(const ImageRegion & whole, std::uint64_t number)
{
  ImageRegion::SizeType size = whole.GetSize();
  std::uint64_t         pieces = 1;
  for (unsigned int axis = Axes; axis-- > GetFirstSplitAxis(whole) && pieces < number;)
  {
    const std::uint64_t cuts = std::min<std::uint64_t>((number + pieces - 1) / pieces, whole.GetSize(axis));
    size[axis] = whole.GetSize(axis) / cuts;
    pieces *= cuts;
  }
  return size;
}
} // namespace

std::vector<ImageRegion>
SplitIntoPieces(const ImageRegion & whole, std::uint64_t number)
{
  const ImageRegion::SizeType size = GetPieceSize(whole, number);
  std::vector<ImageRegion>    pieces = { whole };
  for (unsigned int axis = Axes; axis-- > 0;)
  {
    std::vector<ImageRegion> parts;
    for (const ImageRegion & piece : pieces)
    {
      for (itk::SizeValueType start = 0; start < whole.GetSize(axis); start += size[axis])
      {
        ImageRegion part = piece;
        part.SetIndex(axis, whole.GetIndex(axis) + static_cast<itk::IndexValueType>(start));
        part.SetSize(axis, std::min(size[axis], whole.GetSize(axis) - start));
        parts.push_back(part);
      }
    }
    pieces = parts;
  }
  return pieces;
}

std::uint64_t
GetMaximumNumberOfPieces(const ImageRegion & whole)
{
  std::uint64_t number = 1;
  for (unsigned int axis = GetFirstSplitAxis(whole); axis < Axes; ++axis)
  {
    number *= whole.GetSize(axis);
  }
  return number;
}

std::uint64_t
GetResidentBytes()
{
  std::ifstream           statistics("/proc/self/statm");
  std::uint64_t           size = 0;
  std::uint64_t           resident = 0;
  constexpr std::uint64_t guess = 100000000; // where there is no such file
  return statistics >> size >> resident ? resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : guess;
}

std::uint64_t
GetMachineBytes()
{
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}
