// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/RunTiles.h"

#include "gtest/gtest.h"

#include <atomic>
#include <stdexcept>
#include <thread>

namespace
{

/** Two tiles for two threads, both of which begin and then throw: the caller's only once the other's is about to. */
struct ThrowingRun
{
  const std::thread::id Caller = std::this_thread::get_id();
  std::atomic<int>      Begun{ 0 };
  std::atomic<bool>     HasOtherThrown{ false };

  std::size_t
  GetNumberOfTiles() const
  {
    return 2;
  }

  void
  ComputeTile(std::size_t, int &)
  {
    ++Begun;
    while (Begun < 2)
    {
      std::this_thread::yield();
    }
    if (std::this_thread::get_id() != Caller)
    {
      HasOtherThrown = true;
      throw std::runtime_error("the other's");
    }
    while (!HasOtherThrown)
    {
      std::this_thread::yield();
    }
    throw std::runtime_error("the caller's");
  }
};

} // namespace

TEST(RunTiles, TheCallersExceptionGoesFirst)
{
  for (int repetition = 0; repetition < 20; ++repetition)
  {
    ThrowingRun run;
    int         monitor = 0;
    try
    {
      itk::Subdivision::RunTiles(run, 2, monitor);
      FAIL() << "nothing was thrown";
    }
    catch (const std::runtime_error & error)
    {
      EXPECT_STREQ(error.what(), "the caller's");
    }
  }
}
