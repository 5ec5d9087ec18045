// SPDX-License-Identifier: Apache-2.0

// Masks as both children of a voxel share their work. Every target includes this file once, into its own
// namespace; the guard is toggled from target to target.

#if defined(SUBDIVISION_MASKS_INL) == defined(HWY_TARGET_TOGGLE)
#  ifdef SUBDIVISION_MASKS_INL
#    undef SUBDIVISION_MASKS_INL
#  else
#    define SUBDIVISION_MASKS_INL
#  endif

#  include "NonOscillatorySubdivision/Scheme.h"

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

/** \brief A mask by what the upper and the lower child have in common, which are each other's mirror images.
 *
 * The upper child weighs the voxel itself with Centre, those at offset +i and -i with Pair[i-1] +- Odd[i-1], and the
 * last one, on its own side only, with Outer. */
template <int VPairs>
struct SharedMask
{
  double Centre;
  double Pair[VPairs];
  double Odd[VPairs];
  double Outer;

  /** Of a mask of the upper child. \c factor is a power of two, so that rounding stays as it is. */
  template <typename TMask>
  static constexpr SharedMask
  FromMask(const TMask & mask, const double factor)
  {
    const double scale = factor / MaskDenominator;
    SharedMask   shared{};
    shared.Centre = scale * mask[VPairs];
    for (int i = 1; i <= VPairs; ++i)
    {
      shared.Pair[i - 1] = scale * (mask[VPairs + i] + mask[VPairs - i]) / 2;
      shared.Odd[i - 1] = scale * (mask[VPairs + i] - mask[VPairs - i]) / 2;
    }
    shared.Outer = scale * mask[2 * VPairs + 1];
    return shared;
  }
};

/** What a pass along one axis weighs values and second differences with. */
struct PassMasks
{
  SharedMask<2> Values;
  SharedMask<1> SecondDifferences;
};

// On the way, sums and differences are up to 144 times the largest voxel (L L f of the restored scheme), and must not
// overflow where the children do not. So voxels are scaled by a power of two as they are read, which is exact but for
// the smallest numbers of the type, and children are scaled back by the last pass.
constexpr double ScaleOfVoxels = 1.0 / 256;
constexpr double ScaleOfChildren = 256;

constexpr PassMasks
MakePassMasks(const Mask values, const double factor)
{
  return { SharedMask<2>::FromMask(values == Mask::Linear ? LinearMask : BSplineMask, factor),
           SharedMask<1>::FromMask(SecondDifferenceMask, factor) };
}

constexpr PassMasks BSplinePass = MakePassMasks(Mask::BSpline, 1);
constexpr PassMasks BSplineLastPass = MakePassMasks(Mask::BSpline, ScaleOfChildren);
constexpr PassMasks LinearPass = MakePassMasks(Mask::Linear, 1);
constexpr PassMasks LinearLastPass = MakePassMasks(Mask::Linear, ScaleOfChildren);

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk

#endif
