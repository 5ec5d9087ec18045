// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/TileRun.h"

namespace itk
{
namespace Subdivision
{

TileMonitor::~TileMonitor() = default;

bool
TileMonitor::CountsLosses() const
{
  return false;
}

void
TileMonitor::Lost(std::size_t, std::size_t)
{}

TileRun::~TileRun() = default;

} // namespace Subdivision
} // namespace itk
