// SPDX-License-Identifier: Apache-2.0
// Indices and integers beyond what a double holds: results do not depend on where an image begins, doubling that
// overflows is an exception, and what is not subdivided is copied exactly.

#include "SubdivisionCommonFilters.h"

#include <cstdint>

using namespace SubdivisionTest;

namespace
{

using WideImage = itk::Image<std::int64_t, 2>;

DoubleImage::Pointer
VolumeFrom(const long start)
{
  const auto image = MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ start, -start, start }, { 12, 7, 6 }));
  FillWithTestData(image.GetPointer(), 0.0, 1.0, 0);
  return image;
}

std::string
ErrorOfDoubling(const long start, const unsigned long size)
{
  auto image = Line::New();
  image->SetLargestPossibleRegion(Line::RegionType({ { start } }, { { size } }));
  auto filter = LineFilter::New();
  filter->SetInput(image);
  try
  {
    filter->UpdateOutputInformation();
  }
  catch (const itk::ExceptionObject & error)
  {
    return error.GetDescription();
  }
  return {};
}

} // namespace

TEST(NonOscillatorySubdivisionIndices, ResultsDoNotDependOnTheStart)
{
  BoundaryConditions<DoubleImage> boundaries;
  for (const BoundaryKind kind : AllBoundaries())
  {
    auto filter = DoubleFilter::New();
    filter->SetBoundaryCondition(boundaries.Get(kind));
    const auto expected = RunFilter(filter.GetPointer(), VolumeFrom(0).GetPointer());
    for (const long start : { (1L << 53) + 1, (1L << 60) + 3, (1L << 62) - 13 })
    {
      const auto output = RunFilter(filter.GetPointer(), VolumeFrom(start).GetPointer());
      ASSERT_EQ(output->GetBufferedRegion(),
                MakeRegion<DoubleImage>({ 2 * start, -2 * start, 2 * start }, { 24, 14, 12 }));
      const auto * const a = ScalarsOf(output.GetPointer());
      const auto * const b = ScalarsOf(expected.GetPointer());
      EXPECT_TRUE(std::equal(a, a + 24 * 14 * 12, b)) << NameOf(kind) << " from " << start;
    }
  }
}

/** A part of the output, at odd indices, far from 0. */
TEST(NonOscillatorySubdivisionIndices, PartsFarFromZero)
{
  const long start = (1L << 60) + 3;
  auto       filter = DoubleFilter::New();
  const auto whole = RunFilter(filter.GetPointer(), VolumeFrom(start).GetPointer());
  auto       part = MakeRegion<DoubleImage>({ 2 * start + 3, -2 * start + 1, 2 * start + 5 }, { 10, 9, 4 });
  filter->SetInput(VolumeFrom(start));
  filter->UpdateOutputInformation();
  filter->GetOutput()->SetRequestedRegion(part);
  filter->Update();
  EXPECT_TRUE(SameBytesAsPartOf(filter->GetOutput(), whole.GetPointer()));
}

TEST(NonOscillatorySubdivisionIndices, OverflowIsAnError)
{
  constexpr long limit = 1L << 62;
  EXPECT_EQ(ErrorOfDoubling(0, 1000), "");
  EXPECT_EQ(ErrorOfDoubling(limit - 4, 4), "");
  EXPECT_EQ(ErrorOfDoubling(-limit, 4), "");
  EXPECT_NE(ErrorOfDoubling(limit - 4, 5), "");
  EXPECT_NE(ErrorOfDoubling(limit, 1), "");
  EXPECT_NE(ErrorOfDoubling(-limit - 1, 4), "");
  EXPECT_NE(ErrorOfDoubling(0, 1UL << 62), "");
  EXPECT_NE(ErrorOfDoubling(0, (1UL << 63) + 1), "");
}

TEST(NonOscillatorySubdivisionIndices, WideIntegersAreCopiedExactly)
{
  const auto image = ImageOf<WideImage>(MakeRegion<WideImage>({ 5, -3 }, { 33, 7 }), [](const auto & index) {
    return std::numeric_limits<std::int64_t>::max() - 7 * index[0] - 1001 * (index[1] + 3);
  });
  auto       filter = itk::NonOscillatorySubdivisionImageFilter<WideImage>::New();
  filter->SetSubdividedAxes(itk::FixedArray<bool, 2>(false));
  EXPECT_TRUE(SameBytes(RunFilter(filter.GetPointer(), image.GetPointer()).GetPointer(), image.GetPointer()));
}
