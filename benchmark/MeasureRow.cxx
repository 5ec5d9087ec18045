// SPDX-License-Identifier: Apache-2.0
#include "MeasureRow.h"

#include "ProcessUsage.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <exception>

namespace subdivision_benchmark
{
namespace
{

/** Runs one update as an iteration of `state`, and adds what it cost the process to `total`. */
void
TimeUpdate(benchmark::State & state, const PreparedUpdate & prepared, ProcessUsage & total)
{
  using Clock = std::chrono::steady_clock;

  const ProcessUsage before = GetProcessUsage();
  const auto         start = Clock::now();
  prepared.Update();
  const std::chrono::duration<double> elapsed = Clock::now() - start;
  total += GetProcessUsage() - before;
  state.SetIterationTime(elapsed.count());
}

void
TimeFreshUpdates(benchmark::State & state, const BenchmarkRow & row, const Workload & workload, ProcessUsage & total)
{
  for (auto _ : state)
  {
    TimeUpdate(state, row.Prepare(workload), total);
  }
}

void
TimeReusedUpdates(benchmark::State & state, const BenchmarkRow & row, const Workload & workload, ProcessUsage & total)
{
  const PreparedUpdate prepared = row.Prepare(workload);
  row.IsSlow ? prepared.TouchOutput() : prepared.Update();
  for (auto _ : state)
  {
    TimeUpdate(state, prepared, total);
  }
}

void
SetCounters(benchmark::State & state, const BenchmarkRow & row, const Workload & workload, const ProcessUsage & total)
{
  if (row.LaneOperationsPerVoxel > 0.0)
  {
    const double edge = workload.Size;
    state.counters["lane_operations"] = row.LaneOperationsPerVoxel * edge * edge * edge;
  }
  const auto perUpdate = benchmark::Counter::kAvgIterations;
  state.counters["minor_faults"] = benchmark::Counter(total.MinorFaults, perUpdate);
  state.counters["user_seconds"] = benchmark::Counter(total.UserSeconds, perUpdate);
  state.counters["system_seconds"] = benchmark::Counter(total.SystemSeconds, perUpdate);
}

} // namespace

void
MeasureRow(benchmark::State & state, const BenchmarkRow & row, const Workload & workload, OutputMemory memory)
{
  try
  {
    ProcessUsage total;
    const auto   timeUpdates = memory == OutputMemory::Fresh ? TimeFreshUpdates : TimeReusedUpdates;
    timeUpdates(state, row, workload, total);
    SetCounters(state, row, workload, total);
  }
  catch (const std::exception & error)
  {
    state.SkipWithError(error.what());
  }
}

} // namespace subdivision_benchmark
