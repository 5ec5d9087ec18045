// SPDX-License-Identifier: Apache-2.0
// Whatever region is asked for, however the image is streamed and however many work units share it: the same bytes.

#include "PoolMultiThreader.h"
#include "SubdivisionCommonFilters.h"
#include "SubdivisionRegionSource.h"

#include "itkImageRegionSplitterMultidimensional.h"
#include "itkPipelineMonitorImageFilter.h"
#include "itkStreamingImageFilter.h"

using namespace SubdivisionTest;

namespace
{

/** A source and the filter under test behind it. */
template <typename TImage>
struct Pipeline
{
  using FilterType = itk::NonOscillatorySubdivisionImageFilter<TImage>;

  BoundaryConditions<TImage>             boundaries;
  typename RegionSource<TImage>::Pointer source = RegionSource<TImage>::New();
  typename FilterType::Pointer           filter = FilterType::New();

  Pipeline(const ref::Index<3> & start, const ref::Index<3> & size, SchemeEnum scheme, BoundaryKind boundary)
  {
    source->SetLargestRegion(MakeRegion<TImage>(start, size));
    filter->SetInput(source->GetOutput());
    filter->SetScheme(scheme);
    filter->SetBoundaryCondition(boundaries.Get(boundary));
  }
};

template <typename TImage>
typename TImage::Pointer
Whole(Pipeline<TImage> & pipeline)
{
  pipeline.filter->UpdateLargestPossibleRegion();
  typename TImage::Pointer whole = pipeline.filter->GetOutput();
  whole->DisconnectPipeline();
  return whole;
}

template <typename TImage>
void
ExpectSubRegionsAsWhole(SchemeEnum scheme, BoundaryKind boundary, unsigned int seed)
{
  SCOPED_TRACE(testing::Message() << scheme << ", " << NameOf(boundary));
  Pipeline<TImage> pipeline({ -7, 3, 0 }, { 37, 12, 11 }, scheme, boundary);
  const auto       whole = Whole(pipeline);

  std::mt19937 engine(seed);
  for (int trial = 0; trial < 12; ++trial)
  {
    const auto       region = RandomSubRegion(whole->GetLargestPossibleRegion(), engine);
    Pipeline<TImage> part({ -7, 3, 0 }, { 37, 12, 11 }, scheme, boundary);
    part.filter->UpdateOutputInformation();
    part.filter->GetOutput()->SetRequestedRegion(region);
    part.filter->Update();
    ASSERT_EQ(part.filter->GetOutput()->GetBufferedRegion(), region);
    ASSERT_TRUE(SameBytesAsPartOf(part.filter->GetOutput(), whole.GetPointer()));
  }
}

/** Streams a pipeline in the given number of divisions, with monitors on both sides of the filter. */
template <typename TImage>
void
ExpectStreamedAsWhole(Pipeline<TImage> & pipeline, const TImage * whole, unsigned int divisions, bool allAxes)
{
  using Monitor = itk::PipelineMonitorImageFilter<TImage>;
  SCOPED_TRACE(testing::Message() << divisions << " divisions");
  auto before = Monitor::New();
  before->SetInput(pipeline.source->GetOutput());
  pipeline.filter->SetInput(before->GetOutput());
  auto after = Monitor::New();
  after->SetInput(pipeline.filter->GetOutput());

  auto streamer = itk::StreamingImageFilter<TImage, TImage>::New();
  streamer->SetInput(after->GetOutput());
  streamer->SetNumberOfStreamDivisions(divisions);
  if (allAxes)
  {
    streamer->SetRegionSplitter(itk::ImageRegionSplitterMultidimensional::New());
  }
  streamer->Update();

  ASSERT_TRUE(SameBytes<TImage>(streamer->GetOutput(), whole));
  const unsigned int pieces =
    streamer->GetModifiableRegionSplitter()->GetNumberOfSplits(whole->GetLargestPossibleRegion(), divisions);
  EXPECT_TRUE(after->VerifyAllInputCanStream(static_cast<int>(pieces)));
  // A piece whose stencil lies within what is there from the piece before is not asked for again.
  EXPECT_TRUE(before->VerifyInputFilterExecutedStreaming(-1));
  EXPECT_TRUE(before->VerifyInputFilterMatchedUpdateOutputInformation());
}

} // namespace

TEST(NonOscillatorySubdivisionRegions, SubRegionsInEveryScheme)
{
  for (const SchemeEnum scheme : AllSchemes())
  {
    ExpectSubRegionsAsWhole<FloatImage>(scheme, BoundaryKind::ZeroFlux, 1);
    ExpectSubRegionsAsWhole<UShortImage>(scheme, BoundaryKind::Mirror, 2);
  }
}

TEST(NonOscillatorySubdivisionRegions, SubRegionsWithEveryBoundary)
{
  for (const BoundaryKind boundary : AllBoundaries())
  {
    ExpectSubRegionsAsWhole<UShortImage>(SchemeEnum::NonOscillatory, boundary, 3);
    ExpectSubRegionsAsWhole<DoubleImage>(SchemeEnum::BoundedLinear, boundary, 4);
  }
}

TEST(NonOscillatorySubdivisionRegions, SingleVoxels)
{
  Pipeline<FloatImage> pipeline({ 2, -2, 5 }, { 6, 3, 4 }, SchemeEnum::NonOscillatory, BoundaryKind::Periodic);
  const auto           whole = Whole(pipeline);
  itk::ImageRegionIteratorWithIndex<FloatImage> it(whole, whole->GetBufferedRegion());
  for (; !it.IsAtEnd(); ++it)
  {
    pipeline.filter->UpdateOutputInformation();
    pipeline.filter->GetOutput()->SetRequestedRegion(FloatImage::RegionType(it.GetIndex(), { { 1, 1, 1 } }));
    pipeline.filter->Update();
    ASSERT_EQ(pipeline.filter->GetOutput()->GetPixel(it.GetIndex()), it.Get()) << it.GetIndex();
  }
}

TEST(NonOscillatorySubdivisionRegions, AnyNumberOfStreamDivisions)
{
  for (const BoundaryKind boundary : AllBoundaries())
  {
    SCOPED_TRACE(NameOf(boundary));
    Pipeline<UShortImage> pipeline({ 0, -5, 4 }, { 21, 9, 14 }, SchemeEnum::NonOscillatory, boundary);
    const auto            whole = Whole(pipeline);
    for (unsigned int divisions = 1; divisions <= 28; ++divisions)
    {
      ASSERT_NO_FATAL_FAILURE(ExpectStreamedAsWhole(pipeline, whole.GetPointer(), divisions, false));
    }
  }
}

TEST(NonOscillatorySubdivisionRegions, StreamedAlongAllAxes)
{
  for (const SchemeEnum scheme : AllSchemes())
  {
    Pipeline<FloatImage> pipeline({ -4, 0, 1 }, { 19, 17, 13 }, scheme, BoundaryKind::ZeroFlux);
    const auto           whole = Whole(pipeline);
    for (const unsigned int divisions : { 8u, 27u })
    {
      ASSERT_NO_FATAL_FAILURE(ExpectStreamedAsWhole(pipeline, whole.GetPointer(), divisions, true));
    }
  }
}

/** An axis that is kept is streamed like the others. */
TEST(NonOscillatorySubdivisionRegions, StreamedAlongAKeptAxis)
{
  Pipeline<UShortImage> pipeline({ 0, 0, -6 }, { 9, 8, 13 }, SchemeEnum::NonOscillatory, BoundaryKind::Mirror);
  SetAxes(pipeline.filter.GetPointer(), { true, true, false });
  const auto whole = Whole(pipeline);
  for (unsigned int divisions = 1; divisions <= 13; ++divisions)
  {
    ASSERT_NO_FATAL_FAILURE(ExpectStreamedAsWhole(pipeline, whole.GetPointer(), divisions, false));
  }
}

TEST(NonOscillatorySubdivisionRegions, AnyNumberOfWorkUnits)
{
  for (const SchemeEnum scheme : AllSchemes())
  {
    for (const ref::Index<3> & size : { ref::Index<3>{ 70, 40, 30 }, ref::Index<3>{ 90, 60, 1 } })
    {
      Pipeline<UShortImage> pipeline({ 1, 2, 3 }, size, scheme, BoundaryKind::ZeroFlux);
      pipeline.filter->SetNumberOfWorkUnits(1);
      const auto whole = Whole(pipeline);
      for (const unsigned int units : { 2u, 3u, 4u, 7u, 16u, 61u })
      {
        pipeline.filter->SetNumberOfWorkUnits(units);
        pipeline.filter->Modified();
        ASSERT_TRUE(SameBytes(Whole(pipeline).GetPointer(), whole.GetPointer())) << scheme << ", " << units;
      }
    }
  }
}

TEST(NonOscillatorySubdivisionRegions, AnyMultiThreader)
{
  Pipeline<FloatImage> pipeline({ 0, 0, 0 }, { 50, 31, 22 }, SchemeEnum::NonOscillatory, BoundaryKind::ZeroFlux);
  const auto           whole = Whole(pipeline);
  using ThreaderEnum = itk::MultiThreaderBaseEnums::Threader;
  for (const ThreaderEnum kind : { ThreaderEnum::Platform, PoolThreader })
  {
    const auto former = itk::MultiThreaderBase::GetGlobalDefaultThreader();
    itk::MultiThreaderBase::SetGlobalDefaultThreader(kind);
    Pipeline<FloatImage> other({ 0, 0, 0 }, { 50, 31, 22 }, SchemeEnum::NonOscillatory, BoundaryKind::ZeroFlux);
    itk::MultiThreaderBase::SetGlobalDefaultThreader(former);
    other.filter->SetNumberOfWorkUnits(5);
    EXPECT_TRUE(SameBytes(Whole(other).GetPointer(), whole.GetPointer())) << kind;
  }
}
