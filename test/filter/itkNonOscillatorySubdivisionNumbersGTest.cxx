// SPDX-License-Identifier: Apache-2.0
// The numbers of docs/scheme.md in one dimension, the order in three, and what becomes of averages.

#include "SubdivisionCommonFilters.h"
#include "SubdivisionNumbers.h"

#include <numeric>

using namespace SubdivisionTest;

namespace
{

std::vector<double>
SubdivideLine(const std::vector<double> & values, SchemeEnum scheme, double tension, BoundaryKind boundary)
{
  BoundaryConditions<Line> boundaries;
  auto                     filter = LineFilter::New();
  filter->SetScheme(scheme);
  filter->SetTension(tension);
  filter->SetBoundaryCondition(boundaries.Get(boundary));
  const auto     output = RunFilter(filter.GetPointer(), LineOf<Line>(values).GetPointer());
  const double * first = ScalarsOf(output.GetPointer());
  return { first, first + CountScalars(output.GetPointer()) };
}

void
ExpectLine(const std::vector<double> & input, SchemeEnum scheme, const std::vector<double> & expectedTimes1024)
{
  const auto output = SubdivideLine(input, scheme, 2.0, BoundaryKind::ZeroFlux);
  ASSERT_EQ(output.size(), expectedTimes1024.size());
  for (std::size_t m = 0; m < output.size(); ++m)
  {
    EXPECT_EQ(output[m] * 1024.0, expectedTimes1024[m]) << "child " << m;
  }
}

/** The cell averages of sin(x + y + z) on n cells of a period along each axis. */
DoubleImage::Pointer
WaveAverages(long n)
{
  const double width = 2.0 * itk::Math::pi / n;
  const double damping = std::pow(std::sin(width / 2.0) / (width / 2.0), 3);
  return ImageOf<DoubleImage>(MakeRegion<DoubleImage>({ 0, 0, 0 }, { n, n, n }), [=](const itk::Index<3> & i) {
    return damping * std::sin((i[0] + i[1] + i[2] + 1.5) * width);
  });
}

double
ErrorOnWave(long n, SchemeEnum scheme, double tension)
{
  BoundaryConditions<DoubleImage> boundaries;
  auto                            filter = DoubleFilter::New();
  filter->SetScheme(scheme);
  filter->SetTension(tension);
  filter->SetBoundaryCondition(boundaries.Get(BoundaryKind::Periodic));
  const auto input = WaveAverages(n);
  return LargestDifference(RunFilter(filter.GetPointer(), input.GetPointer()).GetPointer(),
                           WaveAverages(2 * n).GetPointer());
}

} // namespace

TEST(NonOscillatorySubdivisionNumbers, Step)
{
  ExpectLine(SubdivisionNumbers::Step(), SchemeEnum::Linear, SubdivisionNumbers::StepLinear());
  ExpectLine(SubdivisionNumbers::Step(), SchemeEnum::NonOscillatory, SubdivisionNumbers::StepNonOscillatory());
}

TEST(NonOscillatorySubdivisionNumbers, Bar)
{
  ExpectLine(SubdivisionNumbers::Bar(), SchemeEnum::Linear, SubdivisionNumbers::BarLinear());
  ExpectLine(SubdivisionNumbers::Bar(), SchemeEnum::NonOscillatory, SubdivisionNumbers::BarNonOscillatory());
}

TEST(NonOscillatorySubdivisionNumbers, SixthOrderOnSine)
{
  for (const auto & [cells, expected] : SubdivisionNumbers::SineErrors())
  {
    const auto input = SubdivisionNumbers::SineAverages(cells);
    const auto exact = SubdivisionNumbers::SineAverages(2 * cells);
    const auto error = [&](SchemeEnum scheme, double tension) {
      const auto output = SubdivideLine(input, scheme, tension, BoundaryKind::Periodic);
      return SubdivisionNumbers::LargestDifference(output, exact);
    };
    // The expected errors are given to four digits.
    EXPECT_NEAR(error(SchemeEnum::Linear, 2.0), expected, 0.0006 * expected) << cells << " cells";
    for (const double tension : { 1.01, 2.0, 8.0 })
    {
      EXPECT_NEAR(error(SchemeEnum::NonOscillatory, tension), expected, 0.0006 * expected)
        << cells << " cells, tension " << tension;
    }
  }
}

TEST(NonOscillatorySubdivisionNumbers, SixthOrderInThreeDimensions)
{
  const auto order = [](SchemeEnum scheme, double tension) {
    return std::log2(ErrorOnWave(12, scheme, tension) / ErrorOnWave(24, scheme, tension));
  };
  EXPECT_NEAR(order(SchemeEnum::Linear, 2.0), 6.0, 0.2);
  EXPECT_NEAR(order(SchemeEnum::NonOscillatory, 2.0), 6.0, 0.2);
  EXPECT_NEAR(order(SchemeEnum::NonOscillatory, 1.01), 6.0, 0.2);
}

/** Where the data is smooth, the thresholds change nothing. */
TEST(NonOscillatorySubdivisionNumbers, SchemesAgreeOnWave)
{
  const double linear = ErrorOnWave(16, SchemeEnum::Linear, 2.0);
  EXPECT_NEAR(ErrorOnWave(16, SchemeEnum::NonOscillatory, 1.01), linear, 1e-13);
}

TEST(NonOscillatorySubdivisionNumbers, LinearMovesAveragesByTheSixthDifference)
{
  const std::vector<double> input{ 0.3, -0.9, 0.4, 0.8, -0.2, 0.7, 0.1, -0.5, 0.6, 0.9, -0.7 };
  const auto                output = SubdivideLine(input, SchemeEnum::Linear, 2.0, BoundaryKind::Periodic);
  for (std::size_t j = 0; j < input.size(); ++j)
  {
    const double mean = (output[2 * j] + output[2 * j + 1]) / 2.0;
    EXPECT_NEAR(mean, SubdivisionNumbers::MeanOfChildren(input, static_cast<long>(j)), 1e-15) << "voxel " << j;
  }
}

/** The mean of a voxel's two children under the B-spline scheme is (1, 66, 495, 924, 495, 66, 1)/2048. */
TEST(NonOscillatorySubdivisionNumbers, MeanOfBSplineChildren)
{
  std::vector<double> spike(13, 0.0);
  spike[6] = 1.0;
  const auto                  output = SubdivideLine(spike, SchemeEnum::BSpline, 2.0, BoundaryKind::ZeroFlux);
  const std::array<double, 7> mask{ 1, 66, 495, 924, 495, 66, 1 };
  for (std::size_t j = 3; j < 10; ++j)
  {
    EXPECT_EQ((output[2 * j] + output[2 * j + 1]) / 2.0 * 2048.0, mask[j - 3]);
  }
}

TEST(NonOscillatorySubdivisionNumbers, PeriodicLinearKeepsTheMean)
{
  const auto input = MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ -3, 0, 2 }, { 11, 7, 6 }));
  FillWithTestData(input.GetPointer(), 0.0, 1.0, 4);
  BoundaryConditions<DoubleImage> boundaries;
  auto                            filter = DoubleFilter::New();
  filter->SetScheme(SchemeEnum::Linear);
  filter->SetBoundaryCondition(boundaries.Get(BoundaryKind::Periodic));
  const auto output = RunFilter(filter.GetPointer(), input.GetPointer());

  const auto mean = [](const DoubleImage * image) {
    const double * first = ScalarsOf(image);
    return std::accumulate(first, first + CountScalars(image), 0.0) / static_cast<double>(CountScalars(image));
  };
  EXPECT_NEAR(mean(output), mean(input), 1e-14);
}
