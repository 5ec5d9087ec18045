// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionMasks_h
#define itkSubdivisionMasks_h

#include <array>

namespace itk
{

/** \brief The masks of the subdivision schemes, the radii of their stencils and the place of the children.
 *
 * Everything else in the module derives from these numbers (docs/scheme.md, sections 1 and 2). The masks are those of
 * child k = 0, the upper half of its parent voxel; the masks of child k = 1, the lower half, are the same values
 * reversed. All are integers over \c Denominator.
 *
 * Entry i of a mask of value taps weighs the voxel at offset i - 2 from the parent, entry i of the mask of second
 * differences the second difference centred at offset i - 1.
 *
 * \ingroup NonOscillatorySubdivision
 */
struct SubdivisionMasks
{
  static constexpr int Denominator = 1024;

  /** Mask b of the paper: the B-spline of degree 10. */
  static constexpr std::array<int, 6> BSpline{ { 11, 165, 462, 330, 55, 1 } };

  /** Mask c of the paper, which acts on second differences. */
  static constexpr std::array<int, 4> SecondDifference{ { 3, -285, -111, 9 } };

  /** Mask a of the paper: the linear six-point scheme, which is b plus c after the second difference. */
  static constexpr std::array<int, 6> Linear{ { 14, -126, 924, 276, -74, 10 } };

  /** Both children of a voxel read at most this many voxels to either side of it. */
  static constexpr int ValueRadius = 3;

  /** Second differences that both children of a voxel read, to either side of it. */
  static constexpr int SecondDifferenceRadius = 2;

  /** A threshold is the minimum of the block sums this far to either side. */
  static constexpr int WindowRadius = 2;

  /** Block sums and second differences read one voxel to either side. */
  static constexpr int DifferenceRadius = 1;

  /** Voxels that the non-oscillatory scheme reads to either side of a voxel. */
  static constexpr int ThresholdedRadius = SecondDifferenceRadius + WindowRadius + DifferenceRadius;

  /** Children of each voxel along an axis. */
  static constexpr int Children = 2;

  /** Output index m lies at continuous input index m / 2 + FirstChildPosition. */
  static constexpr double FirstChildPosition = -0.25;
};

} // namespace itk

#endif
