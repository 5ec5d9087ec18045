// SPDX-License-Identifier: Apache-2.0
#ifndef UpdateTimer_h
#define UpdateTimer_h

#include "ProcessUsage.h"

#include <functional>

namespace benchmark
{
class State;
}

namespace subdivision_benchmark
{

/** Times the iterations of a repetition and hands Google Benchmark what they cost.
 *
 * Counters, all for one update: `minor_faults`, `user_seconds` and `system_seconds` of all threads together, and
 * `lane_operations`, where they are known. */
class UpdateTimer
{
public:
  explicit UpdateTimer(benchmark::State & state)
    : m_State(state)
  {}

  /** Runs one iteration. */
  void
  Time(const std::function<void()> & update);

  /** To be called once after the iterations. Lane operations of an update that are not known are 0. */
  void
  SetCounters(double laneOperations);

private:
  benchmark::State & m_State;
  ProcessUsage       m_Total;
};

} // namespace subdivision_benchmark

#endif
