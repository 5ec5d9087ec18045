// SPDX-License-Identifier: Apache-2.0
// Where the output lies: the same physical box, twice the voxels.

#include "SubdivisionCommonFilters.h"

#include "itkContinuousIndex.h"

using namespace SubdivisionTest;

namespace
{

/** An image with a skewed position: turned, mirrored, anisotropic, with a negative start. */
DoubleImage::Pointer
PlacedImage()
{
  const auto image = MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ -5, 3, -1 }, { 7, 4, 1 }));
  FillWithTestData(image.GetPointer(), -1.0, 1.0, 0);
  const double               c = std::cos(0.3);
  const double               s = std::sin(0.3);
  DoubleImage::DirectionType direction;
  direction(0, 0) = c;
  direction(0, 1) = 0.0;
  direction(0, 2) = -s;
  direction(1, 0) = -s;
  direction(1, 1) = 0.0;
  direction(1, 2) = -c;
  direction(2, 0) = 0.0;
  direction(2, 1) = 1.0;
  direction(2, 2) = 0.0;
  const std::array<double, 3> spacing{ 0.7, 1.9, 3.1 };
  const std::array<double, 3> origin{ 12.5, -80.0, 3.25 };
  image->SetDirection(direction);
  image->SetSpacing(spacing.data());
  image->SetOrigin(origin.data());
  return image;
}

/** The corner of the physical box of an image; bit w of `corner` chooses the far end of axis w. */
itk::Point<double, 3>
BoxCorner(const DoubleImage * image, unsigned int corner)
{
  const auto                      region = image->GetLargestPossibleRegion();
  itk::ContinuousIndex<double, 3> index;
  for (unsigned int w = 0; w < 3; ++w)
  {
    const double last = (corner >> w & 1) != 0 ? static_cast<double>(region.GetSize(w)) : 0.0;
    index[w] = static_cast<double>(region.GetIndex(w)) - 0.5 + last;
  }
  itk::Point<double, 3> point;
  image->TransformContinuousIndexToPhysicalPoint(index, point);
  return point;
}

void
ExpectSameBox(const DoubleImage * a, const DoubleImage * b)
{
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    EXPECT_LT(BoxCorner(a, corner).EuclideanDistanceTo(BoxCorner(b, corner)), 1e-12) << "corner " << corner;
  }
}

/** Runs on all 8 choices of axes. */
template <typename TCheck>
void
ForEachChoiceOfAxes(const TCheck & check)
{
  const auto input = PlacedImage();
  for (const ref::Axes<3> & axes : ref::SubsetsOf<3>({ true, true, true }))
  {
    SCOPED_TRACE(testing::Message() << "axes " << axes[0] << axes[1] << axes[2]);
    auto filter = DoubleFilter::New();
    SetAxes(filter.GetPointer(), axes);
    const auto output = RunFilter(filter.GetPointer(), input.GetPointer());
    check(input.GetPointer(), output.GetPointer(), axes);
  }
}

} // namespace

TEST(NonOscillatorySubdivisionGeometry, PhysicalBoxIsKept)
{
  ForEachChoiceOfAxes([](const DoubleImage * input, const DoubleImage * output, const ref::Axes<3> &) {
    ExpectSameBox(input, output);
    EXPECT_EQ(output->GetDirection(), input->GetDirection());
  });
}

TEST(NonOscillatorySubdivisionGeometry, SizeStartAndSpacing)
{
  ForEachChoiceOfAxes([](const DoubleImage * input, const DoubleImage * output, const ref::Axes<3> & axes) {
    const auto before = input->GetLargestPossibleRegion();
    const auto after = output->GetLargestPossibleRegion();
    for (unsigned int w = 0; w < 3; ++w)
    {
      const int factor = axes[w] ? 2 : 1;
      EXPECT_EQ(after.GetSize(w), factor * before.GetSize(w));
      EXPECT_EQ(after.GetIndex(w), factor * before.GetIndex(w));
      EXPECT_EQ(output->GetSpacing()[w], input->GetSpacing()[w] / factor);
    }
    EXPECT_EQ(output->GetBufferedRegion(), after);
  });
}

/** Output index m lies at the continuous input index m/2 - 1/4 along every subdivided axis. */
TEST(NonOscillatorySubdivisionGeometry, ChildrenLieInTheHalvesOfTheirParent)
{
  ForEachChoiceOfAxes([](const DoubleImage * input, const DoubleImage * output, const ref::Axes<3> & axes) {
    for (const itk::Index<3> & m : { itk::Index<3>{ { -10, 6, -2 } }, itk::Index<3>{ { 0, 0, 0 } } })
    {
      itk::Point<double, 3> point;
      output->TransformIndexToPhysicalPoint(m, point);
      itk::ContinuousIndex<double, 3> place;
      // Whether the point lies inside the image does not matter here.
      static_cast<void>(input->TransformPhysicalPointToContinuousIndex(point, place));
      for (unsigned int w = 0; w < 3; ++w)
      {
        EXPECT_NEAR(place[w], axes[w] ? m[w] / 2.0 - 0.25 : m[w], 1e-12);
      }
    }
  });
}

/** With no axis to subdivide, the image comes back as it is. */
TEST(NonOscillatorySubdivisionGeometry, NoAxisKeepsTheImage)
{
  const auto input = PlacedImage();
  auto       filter = DoubleFilter::New();
  SetAxes(filter.GetPointer(), { false, false, false });
  const auto output = RunFilter(filter.GetPointer(), input.GetPointer());
  EXPECT_TRUE(SameBytes(output.GetPointer(), input.GetPointer()));
  EXPECT_EQ(output->GetOrigin(), input->GetOrigin());
}

/** A linear ramp stays the same linear function of the physical point, away from the border. */
TEST(NonOscillatorySubdivisionGeometry, RampStaysInPlace)
{
  auto       input = MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ -9, 4, 1 }, { 14, 13, 12 }));
  const auto placed = PlacedImage();
  input->SetDirection(placed->GetDirection());
  input->SetSpacing(placed->GetSpacing());
  input->SetOrigin(placed->GetOrigin());
  const auto valueAt = [](const DoubleImage * image, const itk::Index<3> & index) {
    itk::Point<double, 3> point;
    image->TransformIndexToPhysicalPoint(index, point);
    return 0.2 * point[0] - 0.5 * point[1] + 0.1 * point[2];
  };
  for (itk::ImageRegionIteratorWithIndex<DoubleImage> it(input, input->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    it.Set(valueAt(input, it.GetIndex()));
  }

  for (const SchemeEnum scheme : AllSchemes())
  {
    auto filter = DoubleFilter::New();
    filter->SetScheme(scheme);
    const auto output = RunFilter(filter.GetPointer(), input.GetPointer());
    auto       interior = output->GetBufferedRegion();
    interior.ShrinkByRadius(10);
    for (itk::ImageRegionIteratorWithIndex<DoubleImage> it(output, interior); !it.IsAtEnd(); ++it)
    {
      ASSERT_NEAR(it.Get(), valueAt(output, it.GetIndex()), 1e-11) << scheme << it.GetIndex();
    }
  }
}

TEST(NonOscillatorySubdivisionGeometry, StartIndexDoesNotChangeValues)
{
  const ref::Index<3> size{ 9, 6, 5 };
  const auto          atZero = MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ 0, 0, 0 }, size));
  const auto          shifted = MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ -31, 1, 7 }, size));
  FillWithTestData(atZero.GetPointer(), 0.0, 1.0, 8);
  FillWithTestData(shifted.GetPointer(), 0.0, 1.0, 8);
  for (const BoundaryKind boundary : AllBoundaries())
  {
    BoundaryConditions<DoubleImage> boundaries;
    auto                            filter = DoubleFilter::New();
    filter->SetBoundaryCondition(boundaries.Get(boundary));
    const auto a = RunFilter(filter.GetPointer(), atZero.GetPointer());
    const auto b = RunFilter(filter.GetPointer(), shifted.GetPointer());
    EXPECT_EQ(LargestDifference(a.GetPointer(), b.GetPointer()), 0.0) << NameOf(boundary);
  }
}

TEST(NonOscillatorySubdivisionGeometry, FirstThreeAxesByDefault)
{
  using Series = itk::Image<float, 4>;
  const auto input = MakeImage<Series>(MakeRegion<Series>({ 1, 2, 3, 4 }, { 3, 2, 4, 5 }));
  FillWithTestData(input.GetPointer(), 0.0, 1.0, 4);
  auto       filter = itk::NonOscillatorySubdivisionImageFilter<Series>::New();
  const auto output = RunFilter(filter.GetPointer(), input.GetPointer());
  EXPECT_EQ(output->GetLargestPossibleRegion(), MakeRegion<Series>({ 2, 4, 6, 4 }, { 6, 4, 8, 5 }));
  EXPECT_EQ(output->GetSpacing()[2], 0.5);
  EXPECT_EQ(output->GetSpacing()[3], 1.0);
}
