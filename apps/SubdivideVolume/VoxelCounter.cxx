// SPDX-License-Identifier: Apache-2.0
#include "VoxelCounter.h"

#include "NonOscillatorySubdivision/RunTiles.h"

#include <algorithm>
#include <mutex>
#include <utility>

namespace
{
using namespace itk::Subdivision;

/** Real numbers that are computed at once to count what was lost. */
constexpr std::uint64_t SlabBytes = 16 << 20;
/** Elements that a thread counts at once. */
constexpr std::uint64_t RangeSize = 1 << 18;

bool
IsReal(const ElementType type)
{
  return type == ElementType::Float || type == ElementType::Double;
}

/** \brief A count over ranges of an array, as RunTiles() takes it. */
template <typename TResult, typename TFunction>
class CountingRun
{
public:
  CountingRun(const Box & box, const Box & part, const std::uint64_t components, TFunction function)
    : m_Function(std::move(function))
  {
    ForEachRange(box, part, [this, components](std::uint64_t offset, std::uint64_t count) {
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
  ComputeTile(const std::size_t number, TileMonitor &)
  {
    const TResult                     result = m_Function(m_Ranges[number].first, m_Ranges[number].second);
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Result.Include(result);
  }

  TResult
  GetResult() const
  {
    return m_Result;
  }

private:
  TFunction                                            m_Function;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> m_Ranges;
  std::mutex                                           m_Mutex;
  TResult                                              m_Result;
};

/** Tells nobody what was computed once more. */
class SilentMonitor : public TileMonitor
{
public:
  explicit SilentMonitor(const TileMonitor * monitor = nullptr)
    : m_Monitor(monitor)
  {}
  void
  Completed(std::size_t) override
  {}
  bool
  IsStopped() const override
  {
    return m_Monitor != nullptr && m_Monitor->IsStopped();
  }

private:
  const TileMonitor * m_Monitor;
};

template <typename TResult, typename TFunction>
TResult
CountRanges(const Box & box, const Box & part, std::uint64_t components, unsigned int threads, TFunction function)
{
  CountingRun<TResult, TFunction> run(box, part, components, std::move(function));
  SilentMonitor                   monitor;
  RunTiles(run, threads, monitor);
  return run.GetResult();
}

/** Whether no child can leave the range of the voxels that it is computed from. */
bool
KeepsRange(const ::Options & options)
{
  const Scheme & scheme = FindScheme(options.Scheme);
  const bool     isAverage = scheme.Values == Mask::BSpline && !scheme.IsSharpened;
  const bool     isUncorrected =
    scheme.Limited == Correction::None || (scheme.Limited == Correction::TowardsLinear && options.Tension == 0.0);
  return isUncorrected && (isAverage || scheme.IsBounded);
}

std::uint64_t
CountRealBytes(const LevelChain & chain, const Box & box)
{
  return CountElements(box) * chain.GetOutput().NumberOfComponents * SizeOf(chain.GetRealType());
}
} // namespace

VoxelCounter::VoxelCounter(LevelChain &             chain,
                           const ImageDescription & input,
                           const ::Options &        options,
                           const unsigned int       threads)
  : m_Chain(chain)
  , m_InputType(input.Component)
  , m_Components(input.NumberOfComponents)
  , m_Threads(threads)
  , m_KeepsRange(KeepsRange(options))
  , m_HasConstant(options.Boundary != "nearest" && options.Boundary != "mirror" && options.Boundary != "periodic")
{}

std::uint64_t
VoxelCounter::GetScratchBytes(const LevelChain & chain, const Box & piece)
{
  return IsReal(chain.GetOutput().Component) ? 0 : std::min(SlabBytes, CountRealBytes(chain, piece));
}

Statistics
VoxelCounter::CountPart(const ElementType type, const Box & box, const void * elements, const Box & part) const
{
  const auto count = [type, elements](std::uint64_t offset, std::uint64_t number) {
    return Count(type, static_cast<const char *>(elements) + offset * SizeOf(type), number);
  };
  return CountRanges<Statistics>(box, part, m_Components, m_Threads, count);
}

bool
VoxelCounter::MayLose(const Box & request, const void * input, const Box & slab, const Statistics & output) const
{
  const ElementType type = m_Chain.GetOutput().Component;
  const bool        reachesLimits = ReachesLimits(type, output);
  if (IsReal(type) || !(reachesLimits || IsReal(m_InputType)))
  {
    return false;
  }
  const Statistics before = this->CountPart(m_InputType, request, input, m_Chain.GetRequest(slab));
  const bool       isFinite = before.NotANumber == 0 && before.Infinite == 0;
  const bool       keepsRange = (m_KeepsRange || before.Minimum == before.Maximum) && !m_HasConstant;
  const bool       fits = before.HasFinite() && !ExceedsLimits(type, before);
  return !isFinite || (m_HasConstant && IsReal(m_InputType)) || (reachesLimits && !(keepsRange && fits));
}

void
VoxelCounter::Include(const Box &         request,
                      const void *        input,
                      const Box &         piece,
                      const void *        output,
                      const TileMonitor & monitor)
{
  m_Input.Include(this->CountPart(m_InputType, request, input, m_Chain.GetShare(piece)));

  const ElementType   type = m_Chain.GetOutput().Component;
  const ElementType   real = m_Chain.GetRealType();
  const std::uint64_t slabs = (CountRealBytes(m_Chain, piece) + SlabBytes - 1) / SlabBytes;
  SilentMonitor       silent(&monitor);
  for (const Box & slab : SplitIntoPieces(piece, slabs))
  {
    const Statistics statistics = this->CountPart(type, piece, output, slab);
    m_Output.Include(statistics);
    if (monitor.IsStopped() || !this->MayLose(request, input, slab, statistics))
    {
      continue;
    }
    m_Reals.Reserve(CountRealBytes(m_Chain, slab));
    m_Chain.Compute(request, input, slab, real, m_Reals.GetData(), silent);
    const auto count = [this, type, real](std::uint64_t offset, std::uint64_t number) {
      return CountLosses(type, real, static_cast<const char *>(m_Reals.GetData()) + offset * SizeOf(real), number);
    };
    m_Losses.Include(CountRanges<Losses>(slab, slab, m_Components, m_Threads, count));
  }
}
