// SPDX-License-Identifier: Apache-2.0
#ifndef MachineMemory_h
#define MachineMemory_h

#include <cstdint>

/** What the process occupies now. */
std::uint64_t
GetResidentBytes();

/** The memory of this machine. */
std::uint64_t
GetMachineBytes();

#endif
