// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_Geometry_h
#define NonOscillatorySubdivision_Geometry_h

#include "NonOscillatorySubdivision/ArrayView.h"
#include "NonOscillatorySubdivisionExport.h"

namespace itk
{
namespace Subdivision
{

// Indices along one subdivided axis (docs/scheme.md, section 2). All throw std::overflow_error where a result does not
// fit: sizes are at most 2^63 - 1, and first and last index are 64-bit integers.

/** The children of some voxels. */
NonOscillatorySubdivision_EXPORT Interval
GetChildren(const Interval & parents);

/** The voxels that have children in an interval of the output, which is not empty. */
NonOscillatorySubdivision_EXPORT Interval
GetParents(const Interval & children);

/** The voxels, some of them perhaps outside the image, that exactly these children depend on.
 * \param radius what both children of a voxel read to either side of it; each reads one voxel less on the far side */
NonOscillatorySubdivision_EXPORT Interval
GetStencil(const Interval & children, int radius);

} // namespace Subdivision
} // namespace itk

#endif
