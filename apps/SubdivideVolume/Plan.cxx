// SPDX-License-Identifier: Apache-2.0
#include "Plan.h"
#include "system/process/MachineMemory.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <thread>

namespace
{
constexpr std::uint64_t MostPieces = 1 << 18; // their list takes memory, too
constexpr std::uint64_t Megabyte = 1000000;
constexpr std::uint64_t ScratchBytesPerThread = itk::Subdivision::Subdivider::MostScratchBytesPerThread;
/** Parts of libraries that are loaded when they are first used, stacks, buffers of files. */
constexpr std::uint64_t SpareBytes = 24 << 20;
/** Pieces that are handed on while they are still in the caches of the system, and yet no shorter than this many rows
 * or planes, since each needs what lies around it. */
constexpr std::uint64_t GoodPieceBytes = 32 << 20;
constexpr std::uint64_t GoodPieceDepth = 64;

class Planner
{
public:
  Planner(const LevelChain &       chain,
          const std::vector<Box> & boxes,
          const VolumeReader &     reader,
          const VolumeWriter *     writer,
          unsigned int             threads)
    : m_Chain(chain)
    , m_Boxes(boxes)
    , m_Reader(reader)
    , m_Writer(writer)
    , m_FixedBytes(GetResidentBytes() + SpareBytes + threads * ScratchBytesPerThread)
  {}

  bool
  WritesParts() const
  {
    return m_Writer == nullptr || m_Writer->WritesParts();
  }

  Plan
  Make(std::uint64_t number, unsigned int buffers) const;

  /** The number of pieces that lets the stages of a run overlap well. */
  std::uint64_t
  GetGoodNumber() const;

  /** What as many pieces as there can be need at least. */
  std::uint64_t
  GetLeastBytes(unsigned int buffers) const;

  /** The least number of pieces that fit a budget, if any does: more pieces never need more memory. */
  std::uint64_t
  FindNumber(std::uint64_t budget, unsigned int buffers) const;

private:
  std::uint64_t
  GetMostPieces() const
  {
    return this->WritesParts() ? std::min(m_Boxes.size() * GetMaximumNumberOfPieces(m_Boxes.front()), MostPieces) : 1;
  }
  std::vector<Box>
  Split(std::uint64_t number) const;
  Plan
  Measure(std::vector<Box> pieces, unsigned int buffers) const;

  const LevelChain &       m_Chain;
  const std::vector<Box> & m_Boxes;
  const VolumeReader &     m_Reader;
  const VolumeWriter *     m_Writer;
  const std::uint64_t      m_FixedBytes;
};

std::vector<Box>
Planner::Split(const std::uint64_t number) const
{
  std::vector<Box> pieces;
  for (const Box & box : m_Boxes)
  {
    const std::uint64_t most = std::min(number, MostPieces);
    const std::uint64_t parts = this->WritesParts() ? (most + m_Boxes.size() - 1) / m_Boxes.size() : 1;
    for (const Box & piece : SplitIntoPieces(box, parts))
    {
      pieces.push_back(piece);
    }
  }
  return pieces;
}

Plan
Planner::Make(const std::uint64_t number, const unsigned int buffers) const
{
  return this->Measure(this->Split(number), buffers);
}

Plan
Planner::Measure(std::vector<Box> pieces, const unsigned int buffers) const
{
  Plan plan;
  plan.Pieces = std::move(pieces);
  plan.Buffers = plan.Pieces.size() > 1 ? buffers : 1;
  const std::uint64_t inputBytes = m_Reader.GetDescription().GetVoxelBytes();
  const std::uint64_t outputBytes = m_Chain.GetOutput().GetVoxelBytes();
  std::uint64_t       scratch = 0;
  for (const Box & piece : plan.Pieces)
  {
    const std::uint64_t request = CountElements(m_Chain.GetRequest(piece)) * inputBytes;
    const std::uint64_t bytes = CountElements(piece) * outputBytes;
    plan.LargestRequest = std::max(plan.LargestRequest, request);
    plan.LargestPiece = std::max(plan.LargestPiece, bytes);
    const std::uint64_t reading = m_Reader.GetScratchBytes(request);
    const std::uint64_t writing = m_Writer == nullptr ? 0 : m_Writer->GetScratchBytes(bytes);
    scratch = std::max(scratch, reading + writing + m_Chain.GetScratchBytes(piece));
  }
  plan.PeakBytes = m_FixedBytes + scratch + plan.Buffers * (plan.LargestRequest + plan.LargestPiece);
  return plan;
}

std::uint64_t
Planner::GetGoodNumber() const
{
  const Box &         first = m_Boxes.front();
  const std::uint64_t rows = GetMaximumNumberOfPieces(first);
  const std::uint64_t planes = first.size() > 1 ? rows / first[1].Size : 1;
  const std::uint64_t depth = planes > 1 ? planes : rows;
  const std::uint64_t bytes = CountElements(first) * m_Chain.GetOutput().GetVoxelBytes();
  return m_Boxes.size() * std::max<std::uint64_t>(std::min(bytes / GoodPieceBytes, depth / GoodPieceDepth), 1);
}

std::uint64_t
Planner::GetLeastBytes(const unsigned int buffers) const
{
  // Pieces differ by a row or a plane, and the first and the last need fewer voxels: a few of all are enough.
  constexpr std::size_t  most = 1000;
  const std::vector<Box> pieces = this->Split(this->GetMostPieces());
  std::vector<Box>       some;
  for (std::size_t i = 0; i < pieces.size(); i += 1 + pieces.size() / most)
  {
    some.push_back(pieces[i]);
  }
  return this->Measure(std::move(some), buffers).PeakBytes;
}

std::uint64_t
Planner::FindNumber(const std::uint64_t budget, const unsigned int buffers) const
{
  std::uint64_t tooFew = 0;
  std::uint64_t enough = this->GetMostPieces();
  while (enough - tooFew > 1)
  {
    const std::uint64_t middle = std::min(2 * tooFew + 1, tooFew + (enough - tooFew) / 2);
    if (this->Make(middle, buffers).PeakBytes <= budget)
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

[[noreturn]] void
FailToKeep(std::uint64_t bytes, bool writesParts)
{
  throw std::runtime_error("--memory cannot be kept: these files need about " +
                           std::to_string((bytes + Megabyte - 1) / Megabyte) +
                           (writesParts ? " MB" : " MB, since the output cannot be written in pieces"));
}
} // namespace

Plan
MakePlan(const Options &          options,
         const LevelChain &       chain,
         const std::vector<Box> & boxes,
         const VolumeReader &     reader,
         const VolumeWriter *     writer,
         const unsigned int       threads)
{
  const Planner planner(chain, boxes, reader, writer, threads);
  if (options.Streams > 0)
  {
    return planner.Make(options.Streams, 2);
  }
  const std::uint64_t budget = options.Memory > 0 ? options.Memory : GetMachineBytes() / 2;
  Plan                plan = planner.Make(planner.GetGoodNumber(), 2);
  const std::uint64_t least = plan.PeakBytes > budget ? planner.GetLeastBytes(1) : 0;
  if (least > budget && options.Memory > 0)
  {
    FailToKeep(least, planner.WritesParts());
  }
  for (unsigned int buffers = 2; plan.PeakBytes > budget && buffers > 0; --buffers)
  {
    plan = planner.Make(planner.FindNumber(budget, buffers), buffers);
  }
  if (plan.PeakBytes > budget && options.Memory > 0)
  {
    FailToKeep(plan.PeakBytes, planner.WritesParts());
  }
  return plan;
}

unsigned int
GetNumberOfThreads(const Options & options)
{
  if (options.Threads > 0)
  {
    return options.Threads;
  }
  const std::uint64_t processors = std::max(1u, std::thread::hardware_concurrency());
  // A quarter of the budget at most is scratch memory.
  const std::uint64_t fitting = options.Memory > 0 ? options.Memory / (4 * ScratchBytesPerThread) : processors;
  return static_cast<unsigned int>(std::clamp<std::uint64_t>(fitting, 1, processors));
}
