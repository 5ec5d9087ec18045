// SPDX-License-Identifier: Apache-2.0
#ifndef ByteOrder_h
#define ByteOrder_h

#include <cstddef>
#include <cstdint>

/** Turns elements of one byte order into those of the machine, in place. */
void
TurnToMachine(bool isBigEndian, std::size_t elementSize, char * bytes, std::uint64_t count);

#endif
