// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_Scheme_h
#define NonOscillatorySubdivision_Scheme_h

#include "NonOscillatorySubdivisionExport.h"

#include <array>
#include <cstddef>
#include <string>

namespace itk
{
namespace Subdivision
{

// The masks, the radii of the stencils and the place of the children stand here and nowhere else (docs/scheme.md,
// sections 1 and 2).

/** Children of a voxel along each subdivided axis. */
inline constexpr int Children = 2;

/** Output index m lies at the continuous input index m / 2 + FirstChildPosition, so m covers half of voxel floor(m /
 * 2), its parent. The lower child is m = 2 j, at j - 1/4; the upper child is m = 2 j + 1, at j + 1/4. */
inline constexpr double FirstChildPosition = -0.25;

/** Masks are integers over this. */
inline constexpr int MaskDenominator = 1024;

// The masks of the upper child (k = 0 of docs/scheme.md, whose parent is p); those of the lower child are the same
// values reversed. Entry i of a mask of six weighs the voxel at offset i - 2 from the parent, entry i of the mask of
// four the second difference centred at offset i - 1.
inline constexpr std::array<int, 6> BSplineMask{ { 11, 165, 462, 330, 55, 1 } };
inline constexpr std::array<int, 6> LinearMask{ { 14, -126, 924, 276, -74, 10 } };
inline constexpr std::array<int, 4> SecondDifferenceMask{ { 3, -285, -111, 9 } };

// Both children of a voxel read this far to either side of it: values, second differences; a threshold is the least of
// the variations this far away, and variations and second differences read one voxel to either side.
inline constexpr int ValueRadius = 3;
inline constexpr int SecondDifferenceRadius = 2;
inline constexpr int WindowRadius = 2;
inline constexpr int DifferenceRadius = 1;

/** What the values are filtered with. */
enum class Mask
{
  BSpline,
  Linear
};

/** What is added to the filtered values, within a limit. */
enum class Correction
{
  None,
  /** Second differences under their mask, within K (section 3). */
  SecondDifferences,
  /** What the linear scheme differs by, within T (section 4). */
  TowardsLinear
};

/** \brief What a scheme is made of. */
struct Scheme
{
  /** For options, Python and printing. */
  const char * Name;
  Mask         Values;
  /** Whether the values are P f, sharpened, instead of f. */
  bool IsSharpened;
  /** Whether what the mask of the values gives is clamped to the range of the neighbours of the parent. */
  bool       IsBounded;
  Correction Limited;

  /** Voxels that both children of a voxel read to either side of it. */
  constexpr int
  Radius() const
  {
    return Limited == Correction::SecondDifferences ? SecondDifferenceRadius + WindowRadius + DifferenceRadius
           : IsSharpened                            ? ValueRadius + 2 * DifferenceRadius
                                                    : ValueRadius;
  }

  /** Whether the scheme has a tension at all. */
  constexpr bool
  HasTension() const
  {
    return Limited != Correction::None;
  }
};

/** All schemes. The index of a scheme is its number in itk::NonOscillatorySubdivisionImageFilterEnums::Scheme. */
inline constexpr Scheme Schemes[] = {
  { "nonoscillatory", Mask::BSpline, false, false, Correction::SecondDifferences },
  { "linear", Mask::Linear, false, false, Correction::None },
  { "bounded", Mask::Linear, false, true, Correction::None },
  { "bspline", Mask::BSpline, false, false, Correction::None },
  { "restored", Mask::BSpline, true, true, Correction::TowardsLinear },
};

/** The scheme of that name.
 * \throw std::invalid_argument that lists the names, where there is none. */
const NonOscillatorySubdivision_EXPORT Scheme &
FindScheme(const std::string & name);

/** Tensions are finite; those of the restored scheme are at least 0, those of the others greater than 1, whether the
 * scheme uses it or not.
 * \throw std::invalid_argument that names the scheme and the range. */
NonOscillatorySubdivision_EXPORT void
CheckTension(const Scheme & scheme, double tension);

} // namespace Subdivision
} // namespace itk

#endif
