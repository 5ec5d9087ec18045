// SPDX-License-Identifier: Apache-2.0
#ifndef BenchmarkRow_h
#define BenchmarkRow_h

#include <functional>
#include <string>

namespace subdivision_benchmark
{

/** What every row of one comparison shares: the edge of the cubic input volume in voxels, and the threads. */
struct Workload
{
  unsigned int Size;
  unsigned int Threads;
};

/** Where the output of a timed update lies: memory new from the system, or memory that the row has written before. */
enum class OutputMemory
{
  Fresh,
  Reused
};

/** A piece of work set up and ready to be timed. Destroying it releases its output. */
struct PreparedUpdate
{
  std::function<void()> Update;
  /** Gives the output its memory and writes all of it, without the work itself. */
  std::function<void()> TouchOutput;
};

/** One line of the comparison: a way of making the volume of twice the size. */
struct BenchmarkRow
{
  std::string                                     Name;
  std::function<PreparedUpdate(const Workload &)> Prepare;
  /** Rows that take tens of seconds are repeated less, and not run once more to warm up. */
  bool IsSlow{ false };
  /** Lane operations (additions, minima, multiply-adds ...) that the arithmetic needs for an input voxel, or 0. */
  double LaneOperationsPerVoxel{ 0.0 };
};

} // namespace subdivision_benchmark

#endif
