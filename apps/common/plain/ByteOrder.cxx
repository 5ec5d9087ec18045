// SPDX-License-Identifier: Apache-2.0
#include "plain/ByteOrder.h"

#include <algorithm>
#include <cstring>

namespace
{
template <std::size_t VSize>
void
SwapElements(char * bytes, std::uint64_t count)
{
  for (char * const end = bytes + count; bytes != end; bytes += VSize)
  {
    std::reverse(bytes, bytes + VSize);
  }
}

void
SwapBytes(std::size_t elementSize, char * bytes, std::uint64_t count)
{
  if (elementSize == 2)
  {
    SwapElements<2>(bytes, count);
  }
  else if (elementSize == 4)
  {
    SwapElements<4>(bytes, count);
  }
  else if (elementSize == 8)
  {
    SwapElements<8>(bytes, count);
  }
}

bool
IsBigEndianMachine()
{
  const std::uint16_t one = 1;
  char                first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}
} // namespace

void
TurnToMachine(const bool isBigEndian, const std::size_t elementSize, char * bytes, const std::uint64_t count)
{
  if (isBigEndian != IsBigEndianMachine())
  {
    SwapBytes(elementSize, bytes, count);
  }
}
