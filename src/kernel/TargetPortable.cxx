// SPDX-License-Identifier: Apache-2.0

// The portable target: the sweep in plain C++.

#define SUBDIVISION_TARGET PortableTarget
#define SUBDIVISION_ATTRIBUTE

#include "kernel/Sweep.h"
#include "kernel/vectors/VectorsPortable.h"
#include "kernel/vectors/ConversionsPortable.h"
#include "kernel/TargetTable-inl.h"

namespace itk
{
namespace Subdivision
{

const TargetTable &
GetPortableTarget()
{
  static constexpr TargetTable target = SUBDIVISION_TARGET::MakeTable("portable");
  return target;
}

} // namespace Subdivision
} // namespace itk
