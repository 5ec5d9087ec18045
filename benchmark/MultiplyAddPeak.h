// SPDX-License-Identifier: Apache-2.0
#ifndef MultiplyAddPeak_h
#define MultiplyAddPeak_h

#include <cstdint>
#include <string>
#include <vector>

namespace benchmark
{
class State;
}

namespace subdivision_benchmark
{

/** A vector instruction set of this processor ("AVX2", "AVX3", "SSE4", ...), and a loop that does nothing but float
 * multiply-adds in its registers. The loop returns how many lanes it multiplied and added. */
struct MultiplyAddTarget
{
  std::string Name;
  double (*Loop)(std::uint64_t rounds);
};

/** The instruction sets that this processor has, the fastest first; none where Highway was not there to build with. */
std::vector<MultiplyAddTarget>
GetMultiplyAddTargets();

/** Measures the loop of one target on `threads` threads at once; a lane operation is one lane's multiply-add. */
void
MeasureMultiplyAddPeak(benchmark::State & state, const MultiplyAddTarget & target, unsigned int threads);

} // namespace subdivision_benchmark

#endif
