// SPDX-License-Identifier: Apache-2.0
#ifndef Statistics_h
#define Statistics_h

#include "NonOscillatorySubdivision/ElementType.h"

#include <cstdint>
#include <limits>

/** What is counted of the voxels' components of an image. */
struct Statistics
{
  double        Minimum = std::numeric_limits<double>::infinity(); // of the finite ones
  double        Maximum = -std::numeric_limits<double>::infinity();
  std::uint64_t NotANumber = 0;
  std::uint64_t Infinite = 0;

  bool
  HasFinite() const
  {
    return Minimum <= Maximum;
  }

  void
  Include(const Statistics & other);
};

/** Counts elements that lie side by side. */
Statistics
Count(itk::Subdivision::ElementType type, const void * elements, std::uint64_t count);

/** How many voxels' components the output's type could not hold. */
struct Losses
{
  std::uint64_t NotANumber = 0; // became 0
  std::uint64_t Clamped = 0;    // became the least or the greatest number of the type
};

#endif
