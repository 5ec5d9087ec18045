// SPDX-License-Identifier: Apache-2.0

// Many at once: filters of different schemes, targets and multi-threaders in several threads of one process, and one
// filter whose parameters change between updates, have the bytes of filters that run alone.

#include "PoolMultiThreader.h"
#include "SubdivisionCommonFilters.h"

#include "itkLabelSubdivisionImageFilter.h"
#ifdef ITK_USE_TBB
#  include "itkTBBMultiThreader.h"
#endif

#include <thread>

using namespace SubdivisionTest;

namespace
{

using ThreaderEnum = itk::MultiThreaderBaseEnums::Threader;
using Labels = itk::Image<unsigned char, 3>;

/** The multi-threaders that ITK was built with. */
std::vector<ThreaderEnum>
GetThreaders()
{
  std::vector<ThreaderEnum> threaders{ ThreaderEnum::Platform, PoolThreader };
#ifdef ITK_USE_TBB
  threaders.push_back(ThreaderEnum::TBB);
#endif
  return threaders;
}

/** A filter that uses a multi-threader. */
template <typename TFilter>
typename TFilter::Pointer
MakeFilter(const ThreaderEnum threader)
{
  auto filter = TFilter::New();
  switch (threader)
  {
    case ThreaderEnum::Platform:
      filter->SetMultiThreader(itk::PlatformMultiThreader::New());
      break;
#ifdef ITK_USE_TBB
    case ThreaderEnum::TBB:
      filter->SetMultiThreader(itk::TBBMultiThreader::New());
      break;
#endif
    default:
      filter->SetMultiThreader(PoolMultiThreader::New());
  }
  return filter;
}

/** What one job of many computes; jobs share their input and their boundary conditions. */
struct Job
{
  SchemeEnum   Scheme;
  double       Tension;
  BoundaryKind Boundary;
  std::string  Target;
  ThreaderEnum Threader;
  unsigned int WorkUnits;
};

std::vector<Job>
MakeJobs(const std::vector<ThreaderEnum> & threaders)
{
  const auto       targets = itk::Subdivision::Target::GetNames();
  std::mt19937     engine(3);
  std::vector<Job> jobs;
  for (const SchemeEnum scheme : AllSchemes())
  {
    for (const std::string & target : targets)
    {
      for (const ThreaderEnum threader : threaders)
      {
        jobs.push_back({ scheme,
                         1.5 + static_cast<double>(engine() % 3),
                         AllBoundaries()[engine() % 4],
                         target,
                         threader,
                         1 + static_cast<unsigned int>(engine() % 7) });
      }
    }
  }
  return jobs;
}

/** What all jobs read, and none writes. */
struct Shared
{
  FloatImage::Pointer            Volume = MakeImage<FloatImage>(MakeRegion<FloatImage>({ -3, 0, 9 }, { 43, 26, 19 }));
  Labels::Pointer                Map = MakeImage<Labels>(MakeRegion<Labels>({ 0, 5, 0 }, { 37, 22, 15 }));
  BoundaryConditions<FloatImage> Boundaries;

  Shared()
  {
    FillWithTestData(Volume.GetPointer(), -1.0, 1.0, 0);
    for (itk::ImageRegionIteratorWithIndex<Labels> it(Map, Map->GetBufferedRegion()); !it.IsAtEnd(); ++it)
    {
      it.Set(static_cast<unsigned char>((it.GetIndex()[0] / 7 + it.GetIndex()[1] / 5 * 3 + it.GetIndex()[2] / 6) % 5));
    }
  }
};

void
SetOptions(FloatFilter * const filter, const Job & job, Shared & shared)
{
  filter->SetScheme(job.Scheme);
  filter->SetTension(job.Tension);
  filter->SetBoundaryCondition(shared.Boundaries.Get(job.Boundary));
  filter->SetTarget(job.Target);
  filter->SetNumberOfWorkUnits(job.WorkUnits);
}

FloatImage::Pointer
RunJob(const Job & job, Shared & shared)
{
  const auto filter = MakeFilter<FloatFilter>(job.Threader);
  SetOptions(filter, job, shared);
  return RunFilter(filter.GetPointer(), shared.Volume.GetPointer());
}

Labels::Pointer
RunLabels(const Job & job, Shared & shared)
{
  const auto filter = MakeFilter<itk::LabelSubdivisionImageFilter<Labels>>(job.Threader);
  filter->SetTarget(job.Target);
  filter->SetNumberOfWorkUnits(job.WorkUnits);
  return RunFilter(filter.GetPointer(), shared.Map.GetPointer());
}

/** Runs each job alone, and then all of them again in some threads at once, each of which begins elsewhere. */
void
ExpectSameAtOnce(const std::vector<Job> & jobs)
{
  Shared                           shared;
  std::vector<FloatImage::Pointer> expected;
  for (const Job & job : jobs)
  {
    expected.push_back(RunJob(job, shared));
  }
  const auto               expectedLabels = RunLabels(jobs.front(), shared);
  constexpr std::size_t    threads = 6;
  std::vector<std::thread> others;
  std::array<int, threads> differing{};
  for (std::size_t thread = 0; thread < threads; ++thread)
  {
    others.emplace_back([&, thread] {
      for (std::size_t i = 0; i < jobs.size(); ++i)
      {
        const std::size_t number = (i + thread * jobs.size() / threads) % jobs.size();
        const auto        output = RunJob(jobs[number], shared);
        const auto        labels = RunLabels(jobs[number], shared);
        differing[thread] += SameBytes(output.GetPointer(), expected[number].GetPointer()) ? 0 : 1;
        differing[thread] += SameBytes(labels.GetPointer(), expectedLabels.GetPointer()) ? 0 : 1;
      }
    });
  }
  for (std::thread & other : others)
  {
    other.join();
  }
  EXPECT_EQ(differing, (std::array<int, threads>{}));
}

} // namespace

TEST(NonOscillatorySubdivisionConcurrency, ManyFiltersInManyThreads)
{
  ExpectSameAtOnce(MakeJobs({ ThreaderEnum::Platform, PoolThreader }));
}

TEST(NonOscillatorySubdivisionConcurrency, ManyFiltersOfTBB)
{
  const auto threaders = GetThreaders();
  if (threaders.back() != ThreaderEnum::TBB)
  {
    GTEST_SKIP() << "This ITK was built without TBB.";
  }
  ExpectSameAtOnce(MakeJobs(threaders));
}

/** One filter in each of two threads: parameters change between updates, as they would in a program with sliders. */
TEST(NonOscillatorySubdivisionConcurrency, ParametersChangeBetweenUpdates)
{
  Shared                           shared;
  const auto                       jobs = MakeJobs({ PoolThreader });
  std::vector<FloatImage::Pointer> expected;
  for (const Job & job : jobs)
  {
    expected.push_back(RunJob(job, shared));
  }
  std::array<int, 2> differing{};
  const auto         change = [&](const int thread) {
    auto filter = FloatFilter::New();
    filter->SetInput(shared.Volume);
    std::mt19937 engine(static_cast<unsigned int>(thread));
    for (int update = 0; update < 80; ++update)
    {
      const std::size_t number = engine() % jobs.size();
      SetOptions(filter, jobs[number], shared);
      filter->Update();
      differing[thread] += SameBytes<FloatImage>(filter->GetOutput(), expected[number].GetPointer()) ? 0 : 1;
    }
  };
  std::thread other(change, 1);
  change(0);
  other.join();
  EXPECT_EQ(differing, (std::array<int, 2>{}));
}
