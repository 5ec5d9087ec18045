// SPDX-License-Identifier: Apache-2.0
#include "ComparisonTable.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace subdivision_benchmark
{
namespace
{

constexpr auto referenceFilter = "ExpandLinear";

double
Median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double
GetCounter(const benchmark::BenchmarkReporter::Run & run, const std::string & name)
{
  const auto counter = run.counters.find(name);
  return counter == run.counters.end() ? 0.0 : counter->second.value;
}

} // namespace

bool
ComparisonTable::ReportContext(const Context & context)
{
  PrintBasicContext(&GetErrorStream(), context);
  return true;
}

void
ComparisonTable::ReportRuns(const std::vector<Run> & runs)
{
  std::vector<double> seconds;
  std::vector<double> processorSeconds;
  std::vector<double> systemSeconds;
  std::vector<double> faults;
  for (const Run & run : runs)
  {
    if (run.run_type != Run::RT_Iteration)
    {
      continue;
    }
    if (run.iterations == 0)
    {
      GetErrorStream() << run.run_name.function_name << ": " << run.error_message << '\n';
      m_HasFailures = true;
      continue;
    }
    seconds.push_back(run.real_accumulated_time / static_cast<double>(run.iterations));
    systemSeconds.push_back(GetCounter(run, "system_seconds"));
    processorSeconds.push_back(GetCounter(run, "user_seconds") + systemSeconds.back());
    faults.push_back(GetCounter(run, "minor_faults"));
  }
  if (seconds.empty())
  {
    return;
  }

  const std::string & name = runs.front().run_name.function_name;
  const auto          slash = std::min(name.find('/'), name.size());
  const double        processor = Median(processorSeconds);
  const double        systemShare = processor > 0.0 ? Median(systemSeconds) / processor : 0.0;
  const Line line{ name.substr(0, slash), name.substr(slash), Median(seconds), processor, systemShare, Median(faults) };
  m_Lines.emplace(runs.front().family_index, line);
  if (line.Filter == referenceFilter)
  {
    m_ReferenceSeconds[line.Workload] = line.Seconds;
  }
}

void
ComparisonTable::Finalize()
{
  std::string workload;
  for (const auto & entry : m_Lines)
  {
    const Line & line = entry.second;
    if (line.Workload != workload)
    {
      workload = line.Workload;
      GetOutputStream() << '\n'
                        << std::left << std::setw(36) << workload << std::right << std::setw(12) << "median ms"
                        << std::setw(16) << "x " + std::string(referenceFilter) << std::setw(14) << "processor ms"
                        << std::setw(10) << "system" << std::setw(13) << "page faults" << '\n';
    }
    PrintLine(line);
  }
}

void
ComparisonTable::PrintLine(const Line & line)
{
  std::ostringstream text;
  text << std::fixed << std::left << std::setw(36) << line.Filter << std::right << std::setw(12) << std::setprecision(2)
       << 1e3 * line.Seconds << std::setw(16);
  const auto reference = m_ReferenceSeconds.find(line.Workload);
  if (reference == m_ReferenceSeconds.end())
  {
    text << "-";
  }
  else
  {
    text << reference->second / line.Seconds;
  }
  text << std::setw(14) << 1e3 * line.ProcessorSeconds << std::setprecision(0) << std::setw(8)
       << 100.0 * line.SystemShare << " %" << std::setw(13) << line.MinorFaults << '\n';
  GetOutputStream() << text.str();
}

} // namespace subdivision_benchmark
