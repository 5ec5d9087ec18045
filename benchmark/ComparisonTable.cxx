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
  std::vector<double> faults;
  double              userSeconds = 0.0;
  double              systemSeconds = 0.0;
  for (const Run & run : runs)
  {
    if (run.run_type != Run::RT_Iteration)
    {
      continue;
    }
    if (run.iterations == 0)
    {
      GetErrorStream() << run.run_name.function_name << ": " << run.error_message << '\n';
      continue;
    }
    seconds.push_back(run.real_accumulated_time / static_cast<double>(run.iterations));
    faults.push_back(GetCounter(run, "minor_faults"));
    userSeconds += GetCounter(run, "user_seconds");
    systemSeconds += GetCounter(run, "system_seconds");
  }
  if (seconds.empty())
  {
    return;
  }

  const std::string & name = runs.front().run_name.function_name;
  const auto          slash = std::min(name.find('/'), name.size());
  const double        processorSeconds = userSeconds + systemSeconds;
  const double        systemShare = processorSeconds > 0.0 ? systemSeconds / processorSeconds : 0.0;
  const Line          line{ name.substr(0, slash), name.substr(slash), Median(seconds), Median(faults), systemShare };
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
                        << std::setw(18) << "x " + std::string(referenceFilter) << std::setw(14) << "page faults"
                        << std::setw(10) << "system" << '\n';
    }
    PrintLine(line);
  }
}

void
ComparisonTable::PrintLine(const Line & line)
{
  std::ostringstream text;
  text << std::fixed << std::left << std::setw(36) << line.Filter << std::right << std::setw(12)
       << std::setprecision(2) << 1e3 * line.Seconds << std::setw(18);
  const auto reference = m_ReferenceSeconds.find(line.Workload);
  if (reference == m_ReferenceSeconds.end())
  {
    text << "-";
  }
  else
  {
    text << reference->second / line.Seconds;
  }
  text << std::setprecision(0) << std::setw(14) << line.MinorFaults << std::setw(8) << 100.0 * line.SystemShare
       << " %\n";
  GetOutputStream() << text.str();
}

} // namespace subdivision_benchmark
