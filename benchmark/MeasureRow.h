// SPDX-License-Identifier: Apache-2.0
#ifndef MeasureRow_h
#define MeasureRow_h

#include "BenchmarkRow.h"

namespace benchmark
{
class State;
}

namespace subdivision_benchmark
{

/** Measures one repetition of a row: `Update()` alone, without setting up and without releasing the output. */
void
MeasureRow(benchmark::State & state, const BenchmarkRow & row, const Workload & workload, OutputMemory memory);

} // namespace subdivision_benchmark

#endif
