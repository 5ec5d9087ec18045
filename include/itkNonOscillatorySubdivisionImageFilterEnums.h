// SPDX-License-Identifier: Apache-2.0
#ifndef itkNonOscillatorySubdivisionImageFilterEnums_h
#define itkNonOscillatorySubdivisionImageFilterEnums_h

#include "NonOscillatorySubdivisionExport.h"

#include <cstdint>
#include <ostream>

namespace itk
{

/** \class NonOscillatorySubdivisionImageFilterEnums
 *
 * \brief Enum classes of NonOscillatorySubdivisionImageFilter.
 *
 * \ingroup NonOscillatorySubdivision
 */
class NonOscillatorySubdivisionImageFilterEnums
{
public:
  /** \class Scheme
   *
   * \ingroup NonOscillatorySubdivision
   *
   * The subdivision scheme. Its number is its index in itk::Subdivision::Schemes, which has its name and its parts.
   *
   * - \c NonOscillatory: sixth-order accurate where the data is smooth, without overshoots at isolated edges.
   * - \c Linear: sixth-order accurate everywhere, rings at edges.
   * - \c BoundedLinear: the linear result, clamped to the range of the voxels next to the parent.
   * - \c BSpline: the B-spline of degree 10; the smoothest, never leaves the range of its stencil.
   * - \c Restored: the B-spline of sharpened values, within limits: nearly as smooth, and sharper.
   */
  enum class Scheme : uint8_t
  {
    NonOscillatory = 0,
    Linear = 1,
    BoundedLinear = 2,
    BSpline = 3,
    Restored = 4
  };
};

/** Prints the name of a scheme. */
extern NonOscillatorySubdivision_EXPORT std::ostream &
operator<<(std::ostream & out, const NonOscillatorySubdivisionImageFilterEnums::Scheme value);

} // namespace itk

#endif
