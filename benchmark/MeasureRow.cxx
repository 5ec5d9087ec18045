// SPDX-License-Identifier: Apache-2.0
#include "MeasureRow.h"

#include "UpdateTimer.h"

#include <benchmark/benchmark.h>

#include <exception>

namespace subdivision_benchmark
{
namespace
{

void
TimeFreshUpdates(benchmark::State & state, UpdateTimer & timer, const BenchmarkRow & row, const Workload & workload)
{
  for (auto _ : state)
  {
    const PreparedUpdate prepared = row.Prepare(workload);
    timer.Time(prepared.Update);
  }
}

void
TimeReusedUpdates(benchmark::State & state, UpdateTimer & timer, const BenchmarkRow & row, const Workload & workload)
{
  const PreparedUpdate prepared = row.Prepare(workload);
  row.IsSlow ? prepared.TouchOutput() : prepared.Update();
  for (auto _ : state)
  {
    timer.Time(prepared.Update);
  }
}

} // namespace

void
MeasureRow(benchmark::State & state, const BenchmarkRow & row, const Workload & workload, OutputMemory memory)
{
  try
  {
    UpdateTimer timer(state);
    const auto  timeUpdates = memory == OutputMemory::Fresh ? TimeFreshUpdates : TimeReusedUpdates;
    timeUpdates(state, timer, row, workload);
    const double edge = workload.Size;
    timer.SetCounters(row.LaneOperationsPerVoxel * edge * edge * edge);
  }
  catch (const std::exception & error)
  {
    state.SkipWithError(error.what());
  }
}

} // namespace subdivision_benchmark
