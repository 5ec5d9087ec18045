// SPDX-License-Identifier: Apache-2.0
#include "Subdivide.hxx"

#include <cstdint>

template SubdivisionReport
Subdivide<std::uint8_t>(const SubdivisionJob & job);
template SubdivisionReport
Subdivide<std::int8_t>(const SubdivisionJob & job);
