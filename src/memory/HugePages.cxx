// SPDX-License-Identifier: Apache-2.0
#include "memory/HugePages.h"

#include <cstdint>
#include <cstdlib>
#include <new>

#ifdef __linux__
#  include <sys/mman.h>
#endif
#ifdef _WIN32
#  include <malloc.h>
#endif

namespace itk
{
namespace Subdivision
{
namespace
{
constexpr std::size_t HugePage = std::size_t{ 2 } << 20;
constexpr std::size_t CacheLine = 64;
} // namespace

void
AdviseHugePages(void * memory, std::size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  // Only whole huge pages: what shares a page with others' memory is left alone.
  const auto begin = (reinterpret_cast<std::uintptr_t>(memory) + HugePage - 1) / HugePage * HugePage;
  const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / HugePage * HugePage;
  if (begin < end)
  {
    // Advice: where it is refused, the memory works all the same.
    (void)madvise(reinterpret_cast<void *>(begin), end - begin, MADV_HUGEPAGE);
  }
#else
  (void)memory;
  (void)bytes;
#endif
}

void
FreeMemory::operator()(void * memory) const
{
#ifdef _WIN32
  _aligned_free(memory);
#else
  std::free(memory);
#endif
}

HugePageMemory
AllocateOnHugePages(std::size_t bytes)
{
  const std::size_t alignment = bytes >= HugePage / 4 ? HugePage : CacheLine;
  const std::size_t size = (bytes + alignment - 1) / alignment * alignment;
#ifdef _WIN32
  HugePageMemory memory(_aligned_malloc(size, alignment));
#else
  HugePageMemory memory(std::aligned_alloc(alignment, size));
#endif
  if (!memory)
  {
    throw std::bad_alloc();
  }
  AdviseHugePages(memory.get(), size);
  return memory;
}

} // namespace Subdivision
} // namespace itk
