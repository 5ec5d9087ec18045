// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzedReference_h
#define FuzzedReference_h

#include "common/SubdivisionReference.h"

/** The slow reference, as SubdividerFuzz calls it. It is compiled by itself, without what counts and watches the code
 * under test: otherwise a fuzzer spends its time there, and collects what is new to the reference only. */
namespace FuzzedReference
{

constexpr unsigned int MostAxes = 3;
using Index3 = SubdivisionReference::Index<MostAxes>;
using Grid3 = SubdivisionReference::Grid<MostAxes>;
using Settings = SubdivisionReference::Settings<MostAxes>;

/** Clamped, mirrored, periodic, or the constant. */
SubdivisionReference::Boundary<MostAxes>
MakeBoundary(unsigned int kind, double constant);

/** A child by its index, which is counted from the start of the output. */
double
GetChild(const Grid3 & image, Settings settings, const Index3 & index);

} // namespace FuzzedReference

#endif
