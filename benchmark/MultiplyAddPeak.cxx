// SPDX-License-Identifier: Apache-2.0
#include "MultiplyAddPeak.h"

#include "ParallelFor.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <numeric>

namespace subdivision_benchmark
{

void
MeasureMultiplyAddPeak(benchmark::State & state, const MultiplyAddTarget & target, unsigned int threads)
{
  // Some tens of milliseconds on current processors.
  constexpr std::uint64_t rounds = std::uint64_t{ 1 } << 24;
  using Clock = std::chrono::steady_clock;

  std::vector<double> laneOperations(threads);
  for (auto _ : state)
  {
    const auto start = Clock::now();
    ParallelFor(threads, [&](std::size_t i) { laneOperations[i] = target.Loop(rounds); });
    const std::chrono::duration<double> elapsed = Clock::now() - start;
    state.SetIterationTime(elapsed.count());
  }
  state.counters["lane_operations"] = std::accumulate(laneOperations.cbegin(), laneOperations.cend(), 0.0);
}

} // namespace subdivision_benchmark
