// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/TileRun.h"

namespace itk
{
namespace Subdivision
{

TileMonitor::~TileMonitor() = default;

TileRun::~TileRun() = default;

} // namespace Subdivision
} // namespace itk
