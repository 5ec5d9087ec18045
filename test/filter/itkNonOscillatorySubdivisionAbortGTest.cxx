// SPDX-License-Identifier: Apache-2.0
// With every threader of ITK and more work units than processors, progress is told of to the end by the thread that
// updates the filter, and an abort by an observer or by another thread ends the run.

#include "PoolMultiThreader.h"
#include "SubdivisionCommonFilters.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

using namespace SubdivisionTest;

namespace
{

FloatImage::Pointer
Volume(const long size)
{
  const auto image = MakeImage<FloatImage>(MakeRegion<FloatImage>({ 0, 0, 0 }, { size, size, size }));
  FillWithTestData(image.GetPointer(), 0.0, 1.0, 0);
  return image;
}

template <typename TThreader>
itk::MultiThreaderBase::Pointer
Make()
{
  return TThreader::New().GetPointer();
}

struct Threading
{
  const char * Name;
  itk::MultiThreaderBase::Pointer (*Make)();
  unsigned int WorkUnits;
};

std::vector<Threading>
AllThreadings()
{
  std::vector<Threading> threadings;
  for (const unsigned int units : { 1u, 2u, 64u })
  {
    threadings.push_back({ "pool", Make<PoolMultiThreader>, units });
    threadings.push_back({ "platform", Make<itk::PlatformMultiThreader>, units });
    threadings.push_back({ "the default", Make<itk::MultiThreaderBase>, units });
  }
  return threadings;
}

FloatFilter::Pointer
MakeFilter(const Threading & threading)
{
  auto       filter = FloatFilter::New();
  const auto threader = threading.Make();
  threader->SetMaximumNumberOfThreads(threading.WorkUnits);
  filter->SetMultiThreader(threader);
  filter->SetNumberOfWorkUnits(threading.WorkUnits);
  return filter;
}

/** Aborts a run before it has come to its end; whether it ended so. */
testing::AssertionResult
IsAbortedByAnObserver(FloatFilter * const filter, const FloatImage * input)
{
  bool  hasAbortEvent = false;
  float last = 0.0f;
  filter->AddObserver(itk::AbortEvent(), [&](const itk::EventObject &) { hasAbortEvent = true; });
  filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    last = filter->GetProgress();
    if (last < 1.0f)
    {
      filter->AbortGenerateDataOn();
    }
  });
  filter->SetInput(input);
  try
  {
    filter->UpdateLargestPossibleRegion();
  }
  catch (const itk::ProcessAborted &)
  {
    filter->RemoveAllObservers();
    return hasAbortEvent ? testing::AssertionSuccess() : testing::AssertionFailure() << "without an AbortEvent";
  }
  filter->RemoveAllObservers();
  return testing::AssertionFailure() << "not aborted, last progress " << last;
}

} // namespace

TEST(NonOscillatorySubdivisionAbort, ProgressIsToldOfWithEveryThreader)
{
  const auto input = Volume(160);
  for (const Threading & threading : AllThreadings())
  {
    SCOPED_TRACE(testing::Message() << threading.Name << ", " << threading.WorkUnits << " work units");
    auto                  filter = MakeFilter(threading);
    std::vector<float>    values;
    std::atomic<bool>     isElsewhere{ false };
    const std::thread::id here = std::this_thread::get_id();
    filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
      isElsewhere = isElsewhere || std::this_thread::get_id() != here;
      values.push_back(filter->GetProgress());
    });
    RunFilter(filter.GetPointer(), input.GetPointer());
    EXPECT_FALSE(isElsewhere);
    // How often the system lets that thread tell is its choice, but not that it does so before the end.
    ASSERT_GE(values.size(), 2u);
    EXPECT_TRUE(std::is_sorted(values.begin(), values.end()));
    EXPECT_LT(values.front(), 1.0f);
    EXPECT_NEAR(values.back(), 1.0f, 1e-5f);
  }
}

TEST(NonOscillatorySubdivisionAbort, ByAnObserverWithEveryThreader)
{
  const auto input = Volume(160);
  for (const Threading & threading : AllThreadings())
  {
    SCOPED_TRACE(testing::Message() << threading.Name << ", " << threading.WorkUnits << " work units");
    auto filter = MakeFilter(threading);
    EXPECT_TRUE(IsAbortedByAnObserver(filter.GetPointer(), input.GetPointer()));
    // And it runs again.
    auto untouched = MakeFilter(threading);
    EXPECT_TRUE(SameBytes(RunFilter(filter.GetPointer(), input.GetPointer()).GetPointer(),
                          RunFilter(untouched.GetPointer(), input.GetPointer()).GetPointer()));
  }
}

/** Of a smaller volume, whose tiles the other threads may have done before the calling one looks. */
TEST(NonOscillatorySubdivisionAbort, IsNeverLost)
{
  const auto input = Volume(64);
  for (int run = 0; run < 10; ++run)
  {
    auto filter = FloatFilter::New();
    bool hasTold = false;
    filter->SetNumberOfWorkUnits(4);
    filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
      hasTold = true;
      filter->AbortGenerateDataOn();
    });
    filter->SetInput(input);
    EXPECT_THROW(filter->UpdateLargestPossibleRegion(), itk::ProcessAborted) << "run " << run;
    EXPECT_TRUE(hasTold);
  }
}

/** An abort that comes while no progress event does. */
TEST(NonOscillatorySubdivisionAbort, ByAnotherThread)
{
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "ITK's flag, which the other thread sets, is no atomic.";
#endif
  auto              filter = FloatFilter::New();
  std::atomic<bool> hasBegun{ false };
  filter->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) { hasBegun = true; });
  filter->SetNumberOfWorkUnits(4);
  filter->SetInput(Volume(200));
  std::thread other([&] {
    while (!hasBegun)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    filter->AbortGenerateDataOn();
  });
  EXPECT_THROW(filter->UpdateLargestPossibleRegion(), itk::ProcessAborted);
  other.join();
}

/** What an observer throws comes out of the update when all threads have stopped. */
TEST(NonOscillatorySubdivisionAbort, ObserversMayThrow)
{
  const auto input = Volume(64);
  for (const Threading & threading : AllThreadings())
  {
    SCOPED_TRACE(testing::Message() << threading.Name << ", " << threading.WorkUnits << " work units");
    auto       filter = MakeFilter(threading);
    const auto tag = filter->AddObserver(itk::ProgressEvent(),
                                         [](const itk::EventObject &) { throw std::runtime_error("an observer's"); });
    filter->SetInput(input);
    EXPECT_THROW(filter->UpdateLargestPossibleRegion(), std::runtime_error);
    filter->RemoveObserver(tag);
    EXPECT_NO_THROW(filter->UpdateLargestPossibleRegion());
  }
}
