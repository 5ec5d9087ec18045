// SPDX-License-Identifier: Apache-2.0
#ifndef GreyValues_h
#define GreyValues_h

#include <cstdint>

/** Scrambled bits (SplitMix64): the same numbers everywhere. */
inline std::uint64_t
Scramble(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/** Noise, flat parts with steps, and spikes, as thresholds differ on each; 16 bits, 12 of them where it is smooth. */
inline std::uint64_t
GetGreyValue(const std::uint64_t position)
{
  switch (position / 7 % 4)
  {
    case 0:
      return Scramble(position) >> 48;
    case 1:
      return (Scramble(position / 7) >> 48) + 5 * (position % 7);
    case 2:
      return 1000 + 300 * (position % 7) * (position % 7);
    default:
      return position % 7 == 3 ? 65535 : 200;
  }
}

#endif
