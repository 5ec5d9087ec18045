// SPDX-License-Identifier: Apache-2.0
#include "UpdateTimer.h"

#include <benchmark/benchmark.h>

#include <chrono>

namespace subdivision_benchmark
{

void
UpdateTimer::Time(const std::function<void()> & update)
{
  using Clock = std::chrono::steady_clock;

  const ProcessUsage before = GetProcessUsage();
  const auto         start = Clock::now();
  update();
  const std::chrono::duration<double> elapsed = Clock::now() - start;
  m_Total += GetProcessUsage() - before;
  m_State.SetIterationTime(elapsed.count());
}

void
UpdateTimer::SetCounters(double laneOperations)
{
  const auto perUpdate = benchmark::Counter::kAvgIterations;
  m_State.counters["minor_faults"] = benchmark::Counter(m_Total.MinorFaults, perUpdate);
  m_State.counters["user_seconds"] = benchmark::Counter(m_Total.UserSeconds, perUpdate);
  m_State.counters["system_seconds"] = benchmark::Counter(m_Total.SystemSeconds, perUpdate);
  if (laneOperations > 0.0)
  {
    m_State.counters["lane_operations"] = laneOperations;
  }
}

} // namespace subdivision_benchmark
