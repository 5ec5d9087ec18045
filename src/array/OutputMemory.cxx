// SPDX-License-Identifier: Apache-2.0
#include "array/OutputMemory.h"

#include "memory/HugePages.h"

#include <algorithm>
#include <cstdlib>

namespace itk
{
namespace Subdivision
{

void
AdviseHugePages(const ArrayView & output)
{
  auto *      begin = static_cast<unsigned char *>(output.Data);
  std::size_t bytes = SizeOf(output.Type);
  for (const ArrayAxis & axis : output.Axes)
  {
    const auto extent =
      static_cast<std::ptrdiff_t>(axis.Size - 1) * axis.Stride * static_cast<std::ptrdiff_t>(SizeOf(output.Type));
    begin += std::min<std::ptrdiff_t>(extent, 0);
    bytes += static_cast<std::size_t>(std::abs(extent));
  }
  AdviseHugePages(begin, bytes);
}

} // namespace Subdivision
} // namespace itk
