// SPDX-License-Identifier: Apache-2.0

// The stages and sweeps put together, and the sweep of a scheme. No include guard: every target includes this file
// once, into its own namespace.

#include "kernel/stages/InPlaneDifferences-inl.h"
#include "kernel/stages/LocalRange-inl.h"
#include "kernel/stages/Restoration-inl.h"
#include "kernel/stages/SeparablePasses-inl.h"
#include "kernel/stages/Sharpening-inl.h"
#include "kernel/stages/SweepDifferences-inl.h"

#include <algorithm>

// These build on the stages above.
#include "kernel/BasicSweep-inl.h"
#include "kernel/LimitedSweep-inl.h"
#include "kernel/PlainSweep-inl.h"
#include "kernel/RestoredSweep-inl.h"

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

template <template <typename, bool, bool> class TSweep, typename T>
Sweep<T> *
MakeForAxes(const SweepSettings & settings)
{
  if (settings.Subdivided.X)
  {
    return settings.Subdivided.Y ? static_cast<Sweep<T> *>(new TSweep<T, true, true>(settings))
                                 : new TSweep<T, true, false>(settings);
  }
  return settings.Subdivided.Y ? static_cast<Sweep<T> *>(new TSweep<T, false, true>(settings))
                               : new TSweep<T, false, false>(settings);
}

template <typename T>
Sweep<T> *
MakeSweep(const SweepSettings & settings)
{
  switch (settings.Scheme.Limited)
  {
    case Correction::SecondDifferences:
      return MakeForAxes<LimitedSweep, T>(settings);
    case Correction::TowardsLinear:
      return MakeForAxes<RestoredSweep, T>(settings);
    default:
      return MakeForAxes<PlainSweep, T>(settings);
  }
}

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
