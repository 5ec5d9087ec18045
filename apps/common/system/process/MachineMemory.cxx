// SPDX-License-Identifier: Apache-2.0
#include "system/process/MachineMemory.h"

#include <fstream>

#include <unistd.h>

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
