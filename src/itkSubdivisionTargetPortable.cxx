// SPDX-License-Identifier: Apache-2.0

// The portable target: the sweep in plain C++.

#define SUBDIVISION_TARGET SubdivisionPortable
#define SUBDIVISION_ATTRIBUTE

#include "itkSubdivisionLanesPortable.h"
#include "itkSubdivisionConversionsPortable.h"
#include "itkSubdivisionTarget-inl.h"

namespace itk
{

const SubdivisionTarget &
GetPortableSubdivisionTarget()
{
  static constexpr SubdivisionTarget target = SUBDIVISION_TARGET::MakeTarget("portable");
  return target;
}

} // namespace itk
