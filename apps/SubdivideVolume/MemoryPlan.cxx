// SPDX-License-Identifier: Apache-2.0
#include "MemoryPlan.h"

#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace
{
constexpr std::uint64_t Megabyte = 1000000;
constexpr std::uint64_t ScratchBytesPerThread = 32 << 20;
/** Parts of libraries that are loaded when they are first used, stacks, buffers of files. */
constexpr std::uint64_t SpareBytes = 24 << 20;
} // namespace

std::uint64_t
MemoryPlan::GetPeakBytes(const std::vector<ImageRegion> & pieces) const
{
  std::uint64_t peak = 0;
  for (const ImageRegion & piece : pieces)
  {
    const PieceBytes bytes = this->GetPieceBytes(piece);
    // The filter, the reader and the writer take turns.
    peak =
      std::max(peak, bytes.Kept + std::max({ NumberOfThreads * ScratchBytesPerThread, bytes.Reader, bytes.Writer }));
  }
  return GetResidentBytes() + SpareBytes + peak;
}

/** More pieces never need more memory. */
std::uint64_t
MemoryPlan::FindNumberOfPieces(std::uint64_t budget) const
{
  std::uint64_t tooFew = 0;
  std::uint64_t enough = GetMaximumNumberOfPieces(Whole);
  while (enough - tooFew > 1)
  {
    const std::uint64_t middle = std::min(2 * tooFew + 1, tooFew + (enough - tooFew) / 2);
    if (this->GetPeakBytes(SplitIntoPieces(Whole, middle)) <= budget)
    {
      enough = middle;
    }
    else
    {
      tooFew = middle;
    }
  }
  return enough;
}

std::vector<ImageRegion>
MemoryPlan::Split(const Options & options) const
{
  if (OutputStreams && options.Streams > 0)
  {
    return SplitIntoPieces(Whole, options.Streams);
  }
  const std::uint64_t            budget = options.Memory > 0 ? options.Memory : GetMachineBytes() / 2;
  const std::vector<ImageRegion> pieces = SplitIntoPieces(Whole, OutputStreams ? this->FindNumberOfPieces(budget) : 1);
  const std::uint64_t            needed = options.Memory > 0 ? this->GetPeakBytes(pieces) : 0;
  if (needed > budget)
  {
    throw std::runtime_error("--memory cannot be kept: these files need about " +
                             std::to_string((needed + Megabyte - 1) / Megabyte) +
                             (OutputStreams ? " MB" : " MB, since the output cannot be written in pieces"));
  }
  return pieces;
}

unsigned int
GetNumberOfThreads(const Options & options)
{
  if (options.Threads > 0)
  {
    return options.Threads;
  }
  const std::uint64_t processors = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  // A quarter of the budget at most is scratch memory.
  const std::uint64_t fitting = options.Memory > 0 ? options.Memory / (4 * ScratchBytesPerThread) : processors;
  return static_cast<unsigned int>(std::clamp<std::uint64_t>(fitting, 1, processors));
}
