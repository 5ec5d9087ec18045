// SPDX-License-Identifier: Apache-2.0
#ifndef BenchmarkOptions_h
#define BenchmarkOptions_h

#include <string>
#include <vector>

namespace subdivision_benchmark
{

/** What to compare; every size is combined with every pixel type and every number of threads. */
struct BenchmarkOptions
{
  std::vector<unsigned int> Sizes{ 250 };
  std::vector<std::string>  Pixels{ "ushort" };
  std::vector<unsigned int> Threads{ 2 };
  int                       Repetitions{ 9 };
  int                       SlowRepetitions{ 1 };
  bool                      WithWindowedSinc{ false };
};

/** Reads the command line and takes Google Benchmark's own flags (--benchmark_...) off it. On --help and on errors it
 * prints and ends the program. */
BenchmarkOptions
ParseCommandLine(int argc, char * argv[]);

} // namespace subdivision_benchmark

#endif
