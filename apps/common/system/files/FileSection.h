// SPDX-License-Identifier: Apache-2.0
#ifndef FileSection_h
#define FileSection_h

#include <cstdint>
#include <string>

/** A part of a file. */
struct FileSection
{
  std::string   Path;
  std::uint64_t Offset = 0;
  std::uint64_t Size = 0;
};

#endif
