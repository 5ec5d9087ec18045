// SPDX-License-Identifier: Apache-2.0
#include "Subdivide.hxx"

template SubdivisionReport
Subdivide<float>(const SubdivisionJob & job);
template SubdivisionReport
Subdivide<double>(const SubdivisionJob & job);
