// SPDX-License-Identifier: Apache-2.0
#ifndef array_LabelTypes_h
#define array_LabelTypes_h

#include <cstdint>

/** Calls a macro with each type that labels can have: the integers of ElementType. */
#define SubdivisionForEachLabelType(Do) \
  Do(std::uint8_t);                     \
  Do(std::int8_t);                      \
  Do(std::uint16_t);                    \
  Do(std::int16_t);                     \
  Do(std::uint32_t);                    \
  Do(std::int32_t);                     \
  Do(std::uint64_t);                    \
  Do(std::int64_t)

#endif
