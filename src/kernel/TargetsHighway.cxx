// SPDX-License-Identifier: Apache-2.0

// The vectorised targets: the sweep once more for every instruction set, chosen at run time.

// These would add code but no speed.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernel/TargetsHighway.cxx"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "kernel/stages/Ring.h"
#include "kernel/Sweep.h"
#include "kernel/vectors/RoundToElement.h"
#include "memory/Layout.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#ifndef TargetsHighway_registry
#  define TargetsHighway_registry
namespace itk
{
namespace Subdivision
{
namespace
{
constexpr int MaximumNumberOfTargets = 16;
TargetTable   GeneratedTargets[MaximumNumberOfTargets];
std::int64_t  GeneratedTargetBits[MaximumNumberOfTargets];
int           NumberOfGeneratedTargets = 0;

bool
RegisterTarget(const std::int64_t bit, const TargetTable & target)
{
  if (bit == HWY_SCALAR || bit == HWY_EMU128)
  {
    // The portable target, whose loops the compiler vectorises, is faster than vectors that are emulated.
    return false;
  }
  GeneratedTargets[NumberOfGeneratedTargets] = target;
  GeneratedTargets[NumberOfGeneratedTargets].Name = hwy::TargetName(bit);
  GeneratedTargetBits[NumberOfGeneratedTargets] = bit;
  ++NumberOfGeneratedTargets;
  return true;
}
} // namespace
} // namespace Subdivision
} // namespace itk
#endif

#undef SUBDIVISION_TARGET
#define SUBDIVISION_TARGET HWY_NAMESPACE
#undef SUBDIVISION_ATTRIBUTE
#define SUBDIVISION_ATTRIBUTE HWY_ATTR

HWY_BEFORE_NAMESPACE();
#include "kernel/vectors/VectorsHighway-inl.h"
#include "kernel/vectors/ConversionsHighway-inl.h"
#include "kernel/TargetTable-inl.h"
namespace itk
{
namespace Subdivision
{
namespace HWY_NAMESPACE
{
constexpr TargetTable ThisTarget = MakeTable("");
}
} // namespace Subdivision
} // namespace itk
HWY_AFTER_NAMESPACE();

// Runs on every processor, and so stands outside of the code for this target.
namespace itk
{
namespace Subdivision
{
namespace HWY_NAMESPACE
{
const bool IsRegistered = RegisterTarget(HWY_TARGET, ThisTarget);
}
} // namespace Subdivision
} // namespace itk

#if HWY_ONCE
namespace itk
{
namespace Subdivision
{

int
GetVectorisedTargets(const TargetTable ** targets, int maximum)
{
  // The lower the bit, the better the target.
  const std::int64_t supported = hwy::SupportedTargets();
  int                count = 0;
  std::int64_t       last = 0;
  while (count < maximum)
  {
    int best = -1;
    for (int i = 0; i < NumberOfGeneratedTargets; ++i)
    {
      const std::int64_t bit = GeneratedTargetBits[i];
      if ((bit & supported) != 0 && bit > last && (best < 0 || bit < GeneratedTargetBits[best]))
      {
        best = i;
      }
    }
    if (best < 0)
    {
      break;
    }
    last = GeneratedTargetBits[best];
    targets[count++] = &GeneratedTargets[best];
  }
  return count;
}

} // namespace Subdivision
} // namespace itk
#endif
