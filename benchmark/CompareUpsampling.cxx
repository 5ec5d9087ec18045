// SPDX-License-Identifier: Apache-2.0

// Times NonOscillatorySubdivisionImageFilter against the filters that a user would pick instead, all in one run: on the
// same volume, with the same threads, the repetitions of all rows shuffled. See README.md of this folder.

#include "BenchmarkOptions.h"
#include "ComparisonTable.h"
#include "FilterRows.h"
#include "LabelRows.h"
#include "MachineContext.h"
#include "MeasureRow.h"
#include "MultiplyAddPeak.h"
#include "NonOscillatorySubdivision/Target.h"
#include "OutputFloorRows.h"

#include "itkMultiThreaderBase.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>

#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace
{
using namespace subdivision_benchmark;

/** Makes "fresh output" mean it: without this, glibc keeps released blocks of up to 32 MiB and hands them out again.
 * Once that threshold is set, glibc no longer raises the other where a program releases much, and what the filters
 * compute in would go back to the system after every use. */
void
ReturnReleasedOutputsToSystem()
{
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

/** Updates that make up one measured repetition: volumes below 128³ are repeated, up to 16 times. */
int
GetIterations(const BenchmarkRow & row, const Workload & workload)
{
  const double ratio = 128.0 / workload.Size;
  return row.IsSlow ? 1 : static_cast<int>(std::clamp(ratio * ratio * ratio, 1.0, 16.0));
}

void
RegisterRow(const BenchmarkRow &     row,
            const std::string &      pixel,
            const Workload &         workload,
            OutputMemory             memory,
            const BenchmarkOptions & options)
{
  const std::string name = row.Name + '/' + pixel + '/' + std::to_string(workload.Size) +
                           "/threads:" + std::to_string(workload.Threads) +
                           (memory == OutputMemory::Fresh ? "/fresh" : "/reused");
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State & state) { MeasureRow(state, row, workload, memory); })
    ->Iterations(GetIterations(row, workload))
    ->Repetitions(row.IsSlow ? options.SlowRepetitions : options.Repetitions)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
}

template <typename TPixel>
void
RegisterWorkload(const std::string & pixel, const Workload & workload, const BenchmarkOptions & options)
{
  std::vector<BenchmarkRow>       rows = MakeFilterRows<TPixel>(options.WithWindowedSinc);
  const std::vector<BenchmarkRow> floorRows = MakeOutputFloorRows<TPixel>();
  const std::vector<BenchmarkRow> labelRows = MakeLabelRows<TPixel>(options.WithWindowedSinc);
  rows.insert(rows.end(), labelRows.cbegin(), labelRows.cend());
  rows.insert(rows.end(), floorRows.cbegin(), floorRows.cend());
  for (const auto memory : { OutputMemory::Fresh, OutputMemory::Reused })
  {
    for (const BenchmarkRow & row : rows)
    {
      RegisterRow(row, pixel, workload, memory, options);
    }
  }
}

void
RegisterWorkloads(const BenchmarkOptions & options)
{
  for (const unsigned int threads : options.Threads)
  {
    for (const std::string & pixel : options.Pixels)
    {
      const auto registerWorkload = pixel == "float" ? RegisterWorkload<float> : RegisterWorkload<unsigned short>;
      for (const unsigned int size : options.Sizes)
      {
        registerWorkload(pixel, { size, threads }, options);
      }
    }
  }
}

void
RegisterMultiplyAddPeak(const MultiplyAddTarget & target, unsigned int threads, int repetitions)
{
  const std::string name = "MultiplyAddPeak@" + target.Name + "/threads:" + std::to_string(threads);
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State & state) { MeasureMultiplyAddPeak(state, target, threads); })
    ->Iterations(1)
    ->Repetitions(repetitions)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
}

/** The peaks of the instruction sets that the kernel was built for. */
void
RegisterMultiplyAddPeaks(const BenchmarkOptions & options)
{
  const auto kernelTargets = itk::Subdivision::Target::GetNames();
  for (const MultiplyAddTarget & target : GetMultiplyAddTargets())
  {
    if (std::find(kernelTargets.cbegin(), kernelTargets.cend(), target.Name) != kernelTargets.cend())
    {
      for (const unsigned int threads : options.Threads)
      {
        RegisterMultiplyAddPeak(target, threads, options.Repetitions);
      }
    }
  }
}

} // namespace

int
main(int argc, char * argv[])
{
  const BenchmarkOptions options = ParseCommandLine(argc, argv);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(
    *std::max_element(options.Threads.cbegin(), options.Threads.cend()));
  ReturnReleasedOutputsToSystem();

  RegisterWorkloads(options);
  RegisterMultiplyAddPeaks(options);
  AddMachineContext();
  ComparisonTable table;
  benchmark::RunSpecifiedBenchmarks(&table);
  return table.HasFailures() ? EXIT_FAILURE : EXIT_SUCCESS;
}
