// SPDX-License-Identifier: Apache-2.0
#include "Pieces.h"

#include <algorithm>

namespace
{
/** How many parts each axis is cut into: some of one axis, all of those after it, none of those before. */
std::vector<std::uint64_t>
GetCuts(const Box & whole, const std::uint64_t number)
{
  std::vector<std::uint64_t> cuts(whole.size(), 1);
  std::uint64_t              pieces = 1;
  for (std::size_t axis = whole.size(); axis-- > 1 && pieces < number;)
  {
    cuts[axis] = std::min<std::uint64_t>((number + pieces - 1) / pieces, whole[axis].Size);
    pieces *= cuts[axis];
  }
  return cuts;
}
} // namespace

std::uint64_t
CountElements(const Box & box)
{
  std::uint64_t number = 1;
  for (const Interval & interval : box)
  {
    number *= interval.Size;
  }
  return number;
}

std::vector<Box>
SplitIntoPieces(const Box & whole, const std::uint64_t number)
{
  const std::vector<std::uint64_t> cuts = GetCuts(whole, number);
  std::vector<Box>                 pieces = { whole };
  for (std::size_t axis = whole.size(); axis-- > 0;)
  {
    // Where to cut: sizes differ by one at most.
    const std::uint64_t size = whole[axis].Size / cuts[axis];
    const std::uint64_t larger = whole[axis].Size % cuts[axis];
    std::vector<Box>    parts;
    for (const Box & piece : pieces)
    {
      for (std::uint64_t cut = 0; cut < cuts[axis]; ++cut)
      {
        Box part = piece;
        part[axis] = { whole[axis].First + static_cast<std::int64_t>(cut * size + std::min(cut, larger)),
                       size + (cut < larger ? 1 : 0) };
        parts.push_back(part);
      }
    }
    pieces = std::move(parts);
  }
  return pieces;
}

std::uint64_t
GetMaximumNumberOfPieces(const Box & whole)
{
  return whole.front().Size > 0 ? CountElements(whole) / whole.front().Size : 0;
}
