// SPDX-License-Identifier: Apache-2.0
// The phantom of docs/scheme.md: overshoots of the linear scheme, none of the non-oscillatory one, and agreement of the
// two where the data is smooth.

#include "SubdivisionCommonFilters.h"
#include "SubdivisionPhantom.h"

using namespace SubdivisionTest;

namespace
{

DoubleImage::Pointer
SubdividedPhantom(SchemeEnum scheme, double tension)
{
  constexpr long n = SubdivisionPhantom::Size;
  const auto     phantom =
    ImageOf<DoubleImage>(MakeRegion<DoubleImage>({ 0, 0, 0 }, { n, n, n }), [](const itk::Index<3> & i) {
      return SubdivisionPhantom::ValueAt(
        { static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2]) });
    });
  auto filter = DoubleFilter::New();
  filter->SetScheme(scheme);
  filter->SetTension(tension);
  return RunFilter(filter.GetPointer(), phantom.GetPointer());
}

std::pair<double, double>
RangeOf(const DoubleImage * image)
{
  const double * first = ScalarsOf(image);
  const auto     range = std::minmax_element(first, first + CountScalars(image));
  return { *range.first, *range.second };
}

} // namespace

TEST(NonOscillatorySubdivisionPhantom, LinearOvershoots)
{
  const auto range = RangeOf(SubdividedPhantom(SchemeEnum::Linear, 2.0));
  EXPECT_NEAR(range.first, -0.3127940520644188, 1e-14);
  EXPECT_NEAR(range.second, 1.5234947204589844, 1e-14);
}

TEST(NonOscillatorySubdivisionPhantom, NonOscillatoryKeepsTheRange)
{
  for (const double tension : { 1.01, 1.5, 2.0, 4.0, 8.0 })
  {
    const auto range = RangeOf(SubdividedPhantom(SchemeEnum::NonOscillatory, tension));
    EXPECT_EQ(range.first, 0.0) << "tension " << tension;
    EXPECT_EQ(range.second, 1.0) << "tension " << tension;
  }
}

TEST(NonOscillatorySubdivisionPhantom, BoundedAndBSplineKeepTheRange)
{
  for (const SchemeEnum scheme : { SchemeEnum::BoundedLinear, SchemeEnum::BSpline })
  {
    const auto range = RangeOf(SubdividedPhantom(scheme, 2.0));
    EXPECT_EQ(range.first, 0.0) << scheme;
    EXPECT_EQ(range.second, 1.0) << scheme;
  }
}

TEST(NonOscillatorySubdivisionPhantom, SchemesAgreeInsideSpheres)
{
  const auto  linear = SubdividedPhantom(SchemeEnum::Linear, 2.0);
  const auto  nonOscillatory = SubdividedPhantom(SchemeEnum::NonOscillatory, 2.0);
  double      largest = 0.0;
  std::size_t compared = 0;
  for (itk::ImageRegionIteratorWithIndex<DoubleImage> it(linear, linear->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto m = it.GetIndex();
    // The child's centre in voxels of the phantom.
    if (SubdivisionPhantom::IsSmoothAround({ m[0] / 2.0 - 0.25, m[1] / 2.0 - 0.25, m[2] / 2.0 - 0.25 }))
    {
      largest = std::max(largest, std::abs(it.Get() - nonOscillatory->GetPixel(m)));
      ++compared;
    }
  }
  EXPECT_GT(compared, 100000u);
  EXPECT_LE(largest, 1e-12);
}
