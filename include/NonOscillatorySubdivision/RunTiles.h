// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_RunTiles_h
#define NonOscillatorySubdivision_RunTiles_h

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace itk
{
namespace Subdivision
{

/** Computes all tiles of a run (a Subdivider, or what has its two functions) with that many threads, the caller's among
 * them; returns when all are done. The first exception of any thread keeps the others from beginning another tile and
 * is passed on; but that of the caller's own thread goes before the others', which the monitor may have ended for it.
 * For callers that bring no threads of their own: the library itself has none. */
template <typename TRun, typename TMonitor>
void
RunTiles(TRun & run, const unsigned int threads, TMonitor & monitor)
{
  const std::size_t        tiles = run.GetNumberOfTiles();
  std::atomic<std::size_t> next{ 0 };
  std::exception_ptr       exception;
  std::mutex               mutex;
  const std::thread::id    caller = std::this_thread::get_id();
  const auto               work = [&] {
    try
    {
      for (std::size_t tile = next++; tile < tiles; tile = next++)
      {
        run.ComputeTile(tile, monitor);
      }
    }
    catch (...)
    {
      next = tiles;
      const std::lock_guard<std::mutex> lock(mutex);
      if (!exception || std::this_thread::get_id() == caller)
      {
        exception = std::current_exception();
      }
    }
  };
  std::vector<std::thread> others;
  const std::size_t        useful = std::min<std::size_t>(std::max(threads, 1u), tiles);
  try
  {
    while (others.size() + 1 < useful)
    {
      others.emplace_back(work);
    }
  }
  catch (...)
  {
    // Without more threads, those that there are do the work.
  }
  work();
  for (std::thread & other : others)
  {
    other.join();
  }
  if (exception)
  {
    std::rethrow_exception(exception);
  }
}

} // namespace Subdivision
} // namespace itk

#endif
