// SPDX-License-Identifier: Apache-2.0
// Progress rises evenly from 0 to 1; an abort stops the filter soon, and it runs again afterwards.

#include "SubdivisionCommonFilters.h"

#include "itkCommand.h"

#include <functional>

using namespace SubdivisionTest;

namespace
{

/** Calls a function at every progress event, with the progress. */
class ProgressObserver : public itk::Command
{
public:
  using Self = ProgressObserver;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

  std::function<void(itk::ProcessObject &)> OnProgress;

  void
  Execute(itk::Object * caller, const itk::EventObject &) override
  {
    OnProgress(*dynamic_cast<itk::ProcessObject *>(caller));
  }
  void
  Execute(const itk::Object *, const itk::EventObject &) override
  {}
};

void
Observe(itk::ProcessObject * filter, const std::function<void(itk::ProcessObject &)> & onProgress)
{
  auto observer = ProgressObserver::New();
  observer->OnProgress = onProgress;
  filter->AddObserver(itk::ProgressEvent(), observer);
}

FloatImage::Pointer
Volume(const ref::Index<3> & size)
{
  const auto image = MakeImage<FloatImage>(MakeRegion<FloatImage>({ 0, 0, 0 }, size));
  FillWithTestData(image.GetPointer(), 0.0, 1.0, 0);
  return image;
}

void
UseOneThread(FloatFilter * filter)
{
  filter->GetMultiThreader()->SetMaximumNumberOfThreads(1);
  filter->SetNumberOfWorkUnits(1);
}

/** The progress that a run tells of. ITK calls observers in the thread that updates the filter only. */
std::vector<float>
ProgressOf(FloatFilter * filter, const FloatImage * input)
{
  std::vector<float> values;
  Observe(filter, [&](itk::ProcessObject & process) { values.push_back(process.GetProgress()); });
  RunFilter(filter, input);
  return values;
}

/** ITK adds progress up in fixed point. */
constexpr float Rounding = 1e-5f;

void
ExpectEvenRise(const std::vector<float> & values, float largestStep)
{
  ASSERT_FALSE(values.empty());
  EXPECT_LE(values.front(), largestStep);
  EXPECT_NEAR(values.back(), 1.0f, Rounding);
  for (std::size_t i = 1; i < values.size(); ++i)
  {
    ASSERT_GE(values[i], values[i - 1]);
    ASSERT_LE(values[i], 1.0f);
    ASSERT_LE(values[i] - values[i - 1], largestStep) << "event " << i;
  }
}

} // namespace

TEST(NonOscillatorySubdivisionProgress, RisesEvenly)
{
  for (const SchemeEnum scheme : AllSchemes())
  {
    SCOPED_TRACE(testing::Message() << scheme);
    auto filter = FloatFilter::New();
    filter->SetScheme(scheme);
    UseOneThread(filter);
    ExpectEvenRise(ProgressOf(filter, Volume({ 120, 100, 60 })), 0.06f);
  }
}

TEST(NonOscillatorySubdivisionProgress, ReachesOneOnASingleVoxel)
{
  auto       filter = FloatFilter::New();
  const auto values = ProgressOf(filter, Volume({ 1, 1, 1 }));
  ASSERT_FALSE(values.empty());
  EXPECT_NEAR(values.back(), 1.0f, Rounding);
}

/** With several threads, how evenly the calling one gets to tell is the system's choice, but not where it ends. */
TEST(NonOscillatorySubdivisionProgress, ReachesOneWithSeveralThreads)
{
  for (const unsigned int units : { 2u, 3u, 8u })
  {
    auto filter = FloatFilter::New();
    filter->SetNumberOfWorkUnits(units);
    ExpectEvenRise(ProgressOf(filter, Volume({ 90, 80, 70 })), 1.0f);
  }
}

TEST(NonOscillatorySubdivisionProgress, AbortStopsSoonAndTheFilterRunsAgain)
{
  const auto input = Volume({ 120, 100, 60 });
  auto       untouched = FloatFilter::New();
  const auto expected = RunFilter(untouched.GetPointer(), input.GetPointer());

  auto filter = FloatFilter::New();
  UseOneThread(filter);
  bool  abort = true;
  float abortedAt = 0.0f;
  float last = 0.0f;
  Observe(filter, [&](itk::ProcessObject & process) {
    last = process.GetProgress();
    if (abort && abortedAt == 0.0f && last > 0.3f)
    {
      abortedAt = last;
      process.AbortGenerateDataOn();
    }
  });
  filter->SetInput(input);
  EXPECT_THROW(filter->UpdateLargestPossibleRegion(), itk::ProcessAborted);
  EXPECT_GT(abortedAt, 0.3f);
  EXPECT_LT(last, abortedAt + 0.1f);

  abort = false;
  EXPECT_TRUE(SameBytes(RunFilter(filter.GetPointer(), input.GetPointer()).GetPointer(), expected.GetPointer()));
  EXPECT_NEAR(last, 1.0f, Rounding);
}

/** Should the system leave the calling thread, the only one that observers hear of, without a tile, nothing is aborted.
 */
TEST(NonOscillatorySubdivisionProgress, AbortStopsAllThreads)
{
  auto filter = FloatFilter::New();
  filter->SetNumberOfWorkUnits(4);
  bool requested = false;
  bool aborted = false;
  filter->AddObserver(itk::AbortEvent(), [&](const itk::EventObject &) { aborted = true; });
  Observe(filter, [&](itk::ProcessObject & process) {
    if (process.GetProgress() < 0.9f)
    {
      requested = true;
      process.AbortGenerateDataOn();
    }
  });
  filter->SetInput(Volume({ 150, 140, 130 }));
  try
  {
    filter->UpdateLargestPossibleRegion();
    EXPECT_FALSE(requested);
  }
  catch (const itk::ProcessAborted &)
  {
    EXPECT_TRUE(requested);
  }
  EXPECT_EQ(aborted, requested);
}
