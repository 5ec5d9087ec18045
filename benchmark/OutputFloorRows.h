// SPDX-License-Identifier: Apache-2.0
#ifndef OutputFloorRows_h
#define OutputFloorRows_h

#include "BenchmarkRow.h"
#include "ParallelFor.h"

#include "itkImage.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#ifdef __linux__
#  include <sys/mman.h>
#endif

namespace subdivision_benchmark
{

/** Writes `count` pixels, each thread a contiguous part. */
template <typename TPixel>
void
FillInParallel(TPixel * pixels, std::size_t count, unsigned int threads)
{
  ParallelFor(threads, [=](std::size_t part) {
    std::fill(pixels + count * part / threads, pixels + count * (part + 1) / threads, TPixel{ 1 });
  });
}

inline std::size_t
OutputVoxels(const Workload & workload)
{
  const std::size_t edge = 2 * std::size_t{ workload.Size };
  return edge * edge * edge;
}

/** The least that a filter with this output does: itk::Image allocates it, and the threads write it once. */
template <typename TPixel>
PreparedUpdate
PrepareAllocateAndFill(const Workload & workload)
{
  const auto image = itk::Image<TPixel, 3>::New();
  const auto edge = 2 * itk::SizeValueType{ workload.Size };
  image->SetRegions(itk::Size<3>{ { edge, edge, edge } });

  const auto update = [image, workload]() {
    image->Allocate();
    FillInParallel(image->GetBufferPointer(), OutputVoxels(workload), workload.Threads);
  };
  return { update, update };
}

#ifdef MADV_HUGEPAGE
/** The same where the system is asked for huge pages (2 MiB on most) before the first write. */
template <typename TPixel>
PreparedUpdate
PrepareAllocateAndFillHugePages(const Workload & workload)
{
  constexpr std::size_t hugePage = std::size_t{ 2 } << 20;
  const std::size_t     bytes = (OutputVoxels(workload) * sizeof(TPixel) + hugePage - 1) / hugePage * hugePage;

  const auto buffer = std::make_shared<std::unique_ptr<void, decltype(&std::free)>>(nullptr, &std::free);
  const auto update = [buffer, bytes, workload]() {
    if (!*buffer)
    {
      buffer->reset(std::aligned_alloc(hugePage, bytes));
      if (!*buffer)
      {
        throw std::bad_alloc();
      }
      madvise(buffer->get(), bytes, MADV_HUGEPAGE);
    }
    FillInParallel(static_cast<TPixel *>(buffer->get()), OutputVoxels(workload), workload.Threads);
  };
  return { update, update };
}
#endif

/** What the output's memory alone costs. */
template <typename TPixel>
std::vector<BenchmarkRow>
MakeOutputFloorRows()
{
  std::vector<BenchmarkRow> rows{ { "AllocateAndFill", PrepareAllocateAndFill<TPixel> } };
#ifdef MADV_HUGEPAGE
  rows.push_back({ "AllocateAndFillHugePages", PrepareAllocateAndFillHugePages<TPixel> });
#endif
  return rows;
}

} // namespace subdivision_benchmark

#endif
