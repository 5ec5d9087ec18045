// SPDX-License-Identifier: Apache-2.0
#include "VoxelCounter.h"

#include "volumes/BoxRuns.h"

#include "NonOscillatorySubdivision/RunTiles.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace
{
using namespace itk::Subdivision;

/** Elements that a thread counts at once. */
constexpr std::uint64_t RangeSize = 1 << 18;

/** \brief A count over the ranges of an array that a box within it occupies, as RunTiles() takes it. */
class CountingRun
{
public:
  CountingRun(ElementType type, const Box & box, const void * elements, const Box & part, std::uint64_t components)
    : m_Type(type)
    , m_Elements(static_cast<const char *>(elements))
  {
    std::vector<std::uint64_t> size;
    Box                        within = part;
    for (std::size_t axis = 0; axis < box.size(); ++axis)
    {
      size.push_back(box[axis].Size);
      within[axis].First -= box[axis].First;
    }
    if (CountElements(part) == 0)
    {
      return;
    }
    ForEachRun(size, within, [this, components](std::uint64_t offset, std::uint64_t count) {
      for (std::uint64_t first = 0; first < count * components; first += RangeSize)
      {
        m_Ranges.emplace_back(offset * components + first, std::min(RangeSize, count * components - first));
      }
    });
  }

  std::size_t
  GetNumberOfTiles() const
  {
    return m_Ranges.size();
  }

  void
  ComputeTile(const std::size_t number, std::mutex & mutex)
  {
    const auto [first, count] = m_Ranges[number];
    const Statistics                  range = Count(m_Type, m_Elements + first * SizeOf(m_Type), count);
    const std::lock_guard<std::mutex> lock(mutex);
    m_Result.Include(range);
  }

  const Statistics &
  GetResult() const
  {
    return m_Result;
  }

private:
  ElementType                                          m_Type;
  const char *                                         m_Elements;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> m_Ranges;
  Statistics                                           m_Result;
};
} // namespace

VoxelCounter::VoxelCounter(const LevelChain & chain, const ImageDescription & input, const unsigned int threads)
  : m_Chain(chain)
  , m_InputType(input.Component)
  , m_Components(input.NumberOfComponents)
  , m_Threads(threads)
{}

Statistics
VoxelCounter::CountPart(const ElementType type, const Box & box, const void * elements, const Box & part) const
{
  CountingRun run(type, box, elements, part, m_Components);
  std::mutex  mutex;
  RunTiles(run, m_Threads, mutex);
  return run.GetResult();
}

void
VoxelCounter::Include(const Box & request, const void * input, const Box & piece, const void * output)
{
  m_Input.Include(this->CountPart(m_InputType, request, input, m_Chain.GetShare(piece)));
  m_Output.Include(this->CountPart(m_Chain.GetOutput().Component, piece, output, piece));
}
