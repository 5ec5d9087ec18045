// SPDX-License-Identifier: Apache-2.0
#include "MultiplyAddPeak.h"

#include "ParallelFor.h"
#include "UpdateTimer.h"

#include <benchmark/benchmark.h>

#include <numeric>

namespace subdivision_benchmark
{

void
MeasureMultiplyAddPeak(benchmark::State & state, const MultiplyAddTarget & target, unsigned int threads)
{
  // Some tens of milliseconds on current processors.
  constexpr std::uint64_t rounds = std::uint64_t{ 1 } << 24;

  std::vector<double> laneOperations(threads);
  const auto          multiplyAdd = [&](std::size_t i) { laneOperations[i] = target.Loop(rounds); };
  UpdateTimer         timer(state);
  for (auto _ : state)
  {
    timer.Time([&] { ParallelFor(threads, multiplyAdd); });
  }
  timer.SetCounters(std::accumulate(laneOperations.cbegin(), laneOperations.cend(), 0.0));
}

} // namespace subdivision_benchmark
