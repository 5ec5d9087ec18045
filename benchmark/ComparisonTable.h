// SPDX-License-Identifier: Apache-2.0
#ifndef ComparisonTable_h
#define ComparisonTable_h

#include <benchmark/benchmark.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace subdivision_benchmark
{

/** Prints, when all is measured, one line a row: the median time, how many times as fast as ExpandImageFilter with
 * linear interpolation on the same workload and memory, the processor time of all threads, the system's share of it,
 * and the page faults. */
class ComparisonTable : public benchmark::BenchmarkReporter
{
public:
  bool
  ReportContext(const Context & context) override;

  void
  ReportRuns(const std::vector<Run> & runs) override;

  void
  Finalize() override;

  /** Whether a row could not be measured; its error has been printed. */
  bool
  HasFailures() const
  {
    return m_HasFailures;
  }

private:
  struct Line
  {
    /** Filter name, and `/pixel/size/threads/memory`. */
    std::string Filter;
    std::string Workload;
    double      Seconds;
    double      ProcessorSeconds;
    double      SystemShare;
    double      MinorFaults;
  };

  void
  PrintLine(const Line & line);

  /** By the order of registration. */
  std::map<std::int64_t, Line> m_Lines;
  /** ExpandImageFilter's times by workload. */
  std::map<std::string, double> m_ReferenceSeconds;
  bool                          m_HasFailures{ false };
};

} // namespace subdivision_benchmark

#endif
