// SPDX-License-Identifier: Apache-2.0
#include "BenchmarkOptions.h"

#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>

#include <cstdlib>

namespace subdivision_benchmark
{
namespace
{

constexpr auto googleBenchmarkFlags =
  "Besides, every flag of Google Benchmark, such as\n"
  "  --benchmark_filter=REGEX     only rows whose name matches; -REGEX: only the others\n"
  "  --benchmark_list_tests       only print the names\n"
  "  --benchmark_out=FILE         write all measurements as JSON, for summarise.py\n";

/** Hands Google Benchmark its flags. Repetitions of all rows are shuffled, so that a drift of the machine's speed hits
 * all rows alike; a flag of the user comes later and wins. */
std::vector<char *>
InitializeGoogleBenchmark(int argc, char * argv[])
{
  static char         interleave[] = "--benchmark_enable_random_interleaving=true";
  std::vector<char *> arguments(argv, argv + argc);
  arguments.insert(arguments.begin() + 1, interleave);
  int count = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  benchmark::Initialize(&count, arguments.data());
  arguments.resize(count);
  return arguments;
}

} // namespace

BenchmarkOptions
ParseCommandLine(int argc, char * argv[])
{
  BenchmarkOptions options;
  CLI::App         app{ "Times the ways of doubling a volume's resolution against each other, in one run." };
  app.footer(googleBenchmarkFlags);
  app.add_option("--size", options.Sizes, "Edges of the cubic input volume, in voxels")
    ->check(CLI::Range(8, 1024))
    ->delimiter(',')
    ->capture_default_str();
  app.add_option("--pixel", options.Pixels, "Pixel types")
    ->check(CLI::IsMember({ "ushort", "float" }))
    ->delimiter(',')
    ->capture_default_str();
  app.add_option("--threads", options.Threads, "Numbers of threads")
    ->check(CLI::Range(1, 128))
    ->delimiter(',')
    ->capture_default_str();
  app.add_option("--repetitions", options.Repetitions, "Repetitions of a row")
    ->check(CLI::PositiveNumber)
    ->capture_default_str();
  app
    .add_option("--slow-repetitions",
                options.SlowRepetitions,
                "Repetitions of the rows that take tens of seconds (B-splines, windowed sinc, Gaussian of labels)")
    ->check(CLI::PositiveNumber)
    ->capture_default_str();
  app.add_flag(
    "--sinc",
    options.WithWindowedSinc,
    "Also time ResampleImageFilter with windowed sinc and, of labels, a Gaussian: minutes a row at 250 voxels");

  // Google Benchmark would print its own help and end the program.
  for (int i = 1; i < argc; ++i)
  {
    if (std::string(argv[i]) == "--help")
    {
      std::cout << app.help();
      std::exit(EXIT_SUCCESS);
    }
  }
  const std::vector<char *> remaining = InitializeGoogleBenchmark(argc, argv);
  try
  {
    app.parse(static_cast<int>(remaining.size()), remaining.data());
  }
  catch (const CLI::ParseError & error)
  {
    std::exit(app.exit(error));
  }
  return options;
}

} // namespace subdivision_benchmark
