// SPDX-License-Identifier: Apache-2.0

#include "itkImageFidelityCalculator.h"
#include "ImageFidelityDefinitions.h"
#include "ImageFidelityPipelines.h"

#include "itkImageRegionIterator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

template <typename TImage>
typename TImage::Pointer
MakeImage(const typename TImage::RegionType & region)
{
  const auto image = TImage::New();
  image->SetRegions(region);
  image->Allocate();
  return image;
}

/** An image that starts at index 0; the values in the order of the memory. */
template <typename TPixel, unsigned int VDimension>
typename itk::Image<TPixel, VDimension>::Pointer
MakeImage(const itk::Size<VDimension> & size, const std::vector<TPixel> & values)
{
  const auto image = MakeImage<itk::Image<TPixel, VDimension>>(itk::ImageRegion<VDimension>(size));
  EXPECT_EQ(values.size(), image->GetLargestPossibleRegion().GetNumberOfPixels());
  std::copy(values.begin(), values.end(), image->GetBufferPointer());
  return image;
}

template <typename TImage>
typename TImage::Pointer
MakeRandomImage(const typename TImage::RegionType & region, unsigned int seed, double scale)
{
  std::mt19937                     generator(seed);
  std::normal_distribution<double> distribution(0.0, scale);
  const auto                       image = MakeImage<TImage>(region);
  for (itk::ImageRegionIterator<TImage> it(image, region); !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<typename TImage::PixelType>(distribution(generator)));
  }
  return image;
}

template <typename TReference, typename TTest>
typename itk::ImageFidelityCalculator<TReference, TTest>::Pointer
MakeCalculator(const itk::SmartPointer<TReference> & reference, const itk::SmartPointer<TTest> & test)
{
  const auto calculator = itk::ImageFidelityCalculator<TReference, TTest>::New();
  calculator->SetReferenceImage(reference);
  calculator->SetTestImage(test);
  return calculator;
}

template <typename TReference, typename TTest>
typename itk::ImageFidelityCalculator<TReference, TTest>::Pointer
Compare(const itk::SmartPointer<TReference> & reference, const itk::SmartPointer<TTest> & test)
{
  const auto calculator = MakeCalculator(reference, test);
  calculator->Update();
  return calculator;
}

template <typename TCalculator>
std::string
GetErrorOfUpdate(const itk::SmartPointer<TCalculator> & calculator)
{
  try
  {
    calculator->Update();
  }
  catch (const itk::ExceptionObject & error)
  {
    return error.GetDescription();
  }
  return "no error";
}

/** Every figure, for comparisons byte by byte. */
template <typename TCalculator>
std::vector<double>
GetFigures(const itk::SmartPointer<TCalculator> & calculator)
{
  std::vector<double> figures = calculator->GetRelativeErrorQuantiles();
  for (const double figure : { calculator->GetEffectivePeak(),
                               calculator->GetPeakSignalToNoiseRatio(),
                               calculator->GetRelativeL2Error(),
                               calculator->GetReferenceTotalVariation(),
                               calculator->GetTestTotalVariation(),
                               calculator->GetRelativeTotalVariation(),
                               calculator->GetReferenceMinimum(),
                               calculator->GetReferenceMaximum(),
                               calculator->GetTestMinimum(),
                               calculator->GetTestMaximum(),
                               static_cast<double>(calculator->GetNumberOfComparedVoxels()),
                               static_cast<double>(calculator->GetNumberOfExcludedVoxels()) })
  {
    figures.push_back(figure);
  }
  return figures;
}

bool
HaveSameBytes(const std::vector<double> & a, const std::vector<double> & b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

template <typename TReference, typename TTest>
void
ExpectDefinitions(const itk::SmartPointer<TReference> & reference,
                  const itk::SmartPointer<TTest> &      test,
                  bool                                  useSpacing)
{
  const auto calculator = MakeCalculator(reference, test);
  calculator->SetQuantileLevels({ 0.0, 0.123, 0.5, 0.99, 1.0 });
  calculator->SetUseImageSpacing(useSpacing);
  calculator->Update();
  ImageFidelityDefinitions<TReference, TTest> expected{ reference, test, useSpacing };
  expected.Evaluate();

  const double peak = calculator->GetReferenceMaximum() - calculator->GetReferenceMinimum();
  const auto   count = static_cast<double>(expected.errors.size());
  const auto   expectClose = [](double value, long double wanted) {
    EXPECT_NEAR(value, static_cast<double>(wanted), 1e-12 * std::abs(static_cast<double>(wanted)));
  };
  EXPECT_EQ(calculator->GetEffectivePeak(), peak);
  EXPECT_EQ(calculator->GetNumberOfComparedVoxels(), expected.errors.size());
  EXPECT_EQ(calculator->GetNumberOfExcludedVoxels(),
            reference->GetLargestPossibleRegion().GetNumberOfPixels() - expected.errors.size());
  expectClose(calculator->GetPeakSignalToNoiseRatio(), 10 * std::log10(peak * peak / (expected.squaredError / count)));
  expectClose(calculator->GetRelativeL2Error(), std::sqrt(expected.squaredError / expected.squaredReference));
  expectClose(calculator->GetReferenceTotalVariation(), expected.referenceTotalVariation);
  expectClose(calculator->GetTestTotalVariation(), expected.testTotalVariation);
  expectClose(calculator->GetRelativeTotalVariation(), expected.testTotalVariation / expected.referenceTotalVariation);
  for (std::size_t i = 0; i < calculator->GetQuantileLevels().size(); ++i)
  {
    const double level = calculator->GetQuantileLevels()[i];
    EXPECT_EQ(calculator->GetRelativeErrorQuantiles()[i], GetQuantileOfSorted(expected.errors, level) / peak);
  }
}

std::vector<double>
FindQuantiles(const std::vector<double> & values, const std::vector<double> & levels)
{
  itk::RadixQuantiles quantiles(levels);
  for (unsigned int pass = 0; pass < itk::RadixQuantiles::NumberOfPasses; ++pass)
  {
    auto counts = quantiles.MakeCounts();
    for (const double value : values)
    {
      quantiles.Count(value, counts);
    }
    quantiles.Merge(counts);
    quantiles.FinishPass();
  }
  return quantiles.GetQuantiles();
}
} // namespace

TEST(RadixQuantiles, AgreeWithSortingForRandomValuesOfAllMagnitudes)
{
  std::mt19937                           generator(1);
  std::uniform_real_distribution<double> exponent(-300.0, 300.0);
  std::vector<double>                    values(10007);
  for (double & value : values)
  {
    value = std::pow(10.0, exponent(generator));
  }
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());

  const std::vector<double> levels{ 0.99, 0.0, 1.0, 0.5, 0.25, 1.0 / 3.0, 0.999, 0.5 };
  const std::vector<double> quantiles = FindQuantiles(values, levels);
  ASSERT_EQ(quantiles.size(), levels.size());
  for (std::size_t i = 0; i < levels.size(); ++i)
  {
    EXPECT_EQ(quantiles[i], GetQuantileOfSorted(sorted, levels[i])) << "level " << levels[i];
  }
}

TEST(RadixQuantiles, DistinguishNeighboursThatDifferInTheLastBit)
{
  const double above = std::nextafter(1.0, 2.0);
  EXPECT_EQ(FindQuantiles({ above, 1.0, above }, { 0.0, 0.5, 1.0 }), (std::vector<double>{ 1.0, above, above }));
}

TEST(RadixQuantiles, HandComputed)
{
  EXPECT_EQ(FindQuantiles({ 4.0, 1.0, 2.0, 8.0 }, { 0.5, 0.25, 1.0 }), (std::vector<double>{ 3.0, 1.75, 8.0 }));
  EXPECT_EQ(FindQuantiles({ 3.0 }, { 0.0, 0.5, 1.0 }), (std::vector<double>{ 3.0, 3.0, 3.0 }));
  EXPECT_EQ(FindQuantiles({ 0.0, 0.0, 0.0, 5.0 }, { 0.5 }), (std::vector<double>{ 0.0 }));
  EXPECT_EQ(FindQuantiles({ 0.0, Infinity, Infinity }, { 0.5, 0.75 }), (std::vector<double>{ Infinity, Infinity }));
  EXPECT_TRUE(FindQuantiles({ 1.0, 2.0 }, {}).empty());
  EXPECT_TRUE(std::isnan(FindQuantiles({}, { 0.5 }).front()));
}

TEST(ImageFidelityCalculator, HandComputed1D)
{
  const auto calculator =
    Compare(MakeImage<float, 1>({ { 4 } }, { 0, 1, 3, 7 }), MakeImage<float, 1>({ { 4 } }, { 0, 2, 3, 3 }));

  // Errors 0, 1, 0, 4; range of the reference 7.
  EXPECT_DOUBLE_EQ(calculator->GetEffectivePeak(), 7.0);
  EXPECT_DOUBLE_EQ(calculator->GetPeakSignalToNoiseRatio(), 10.0 * std::log10(49.0 / (17.0 / 4.0)));
  EXPECT_DOUBLE_EQ(calculator->GetRelativeL2Error(), std::sqrt(17.0 / 59.0));
  ASSERT_EQ(calculator->GetRelativeErrorQuantiles().size(), 2u);
  EXPECT_DOUBLE_EQ(calculator->GetRelativeErrorQuantiles()[0], 0.5 / 7.0);
  EXPECT_DOUBLE_EQ(calculator->GetRelativeErrorQuantiles()[1], (1.0 + 0.97 * 3.0) / 7.0);
  EXPECT_EQ(calculator->GetReferenceTotalVariation(), 7.0);
  EXPECT_EQ(calculator->GetTestTotalVariation(), 3.0);
  EXPECT_DOUBLE_EQ(calculator->GetRelativeTotalVariation(), 3.0 / 7.0);
  EXPECT_EQ(calculator->GetReferenceMinimum(), 0.0);
  EXPECT_EQ(calculator->GetReferenceMaximum(), 7.0);
  EXPECT_EQ(calculator->GetTestMinimum(), 0.0);
  EXPECT_EQ(calculator->GetTestMaximum(), 3.0);
  EXPECT_EQ(calculator->GetNumberOfComparedVoxels(), 4u);
  EXPECT_EQ(calculator->GetNumberOfExcludedVoxels(), 0u);
}

TEST(ImageFidelityCalculator, HandComputed2DWithAndWithoutSpacing)
{
  const auto   reference = MakeImage<double, 2>({ { 2, 2 } }, { 0, 3, 4, 0 });
  const auto   test = MakeImage<double, 2>({ { 2, 2 } }, { 0, 1.5, 2, 0 });
  const double spacing[] = { 0.5, 4.0 };
  reference->SetSpacing(spacing);
  test->SetSpacing(spacing);
  const auto calculator = Compare(reference, test);

  EXPECT_DOUBLE_EQ(calculator->GetReferenceTotalVariation(), 5.0 + 3.0 + 4.0);
  EXPECT_DOUBLE_EQ(calculator->GetTestTotalVariation(), 6.0);
  EXPECT_DOUBLE_EQ(calculator->GetRelativeTotalVariation(), 0.5);
  EXPECT_DOUBLE_EQ(calculator->GetRelativeL2Error(), 0.5);
  EXPECT_DOUBLE_EQ(calculator->GetPeakSignalToNoiseRatio(), 10.0 * std::log10(16.0 / (6.25 / 4.0)));

  calculator->UseImageSpacingOn();
  calculator->Update();
  // Quotients 3 / 0.5 and 4 / 4 at the first voxel, 3 / 4 and 4 / 0.5 at the next ones; a voxel has the area 2.
  EXPECT_DOUBLE_EQ(calculator->GetReferenceTotalVariation(), 2.0 * (std::sqrt(37.0) + 0.75 + 8.0));
  EXPECT_DOUBLE_EQ(calculator->GetRelativeTotalVariation(), 0.5);
}

TEST(ImageFidelityCalculator, HandComputed3D)
{
  // 2 x + 3 y + 6 z on 2 x 2 x 2 voxels, compared with itself plus 1 in one corner.
  const auto reference = MakeImage<short, 3>({ { 2, 2, 2 } }, { 0, 2, 3, 5, 6, 8, 9, 11 });
  const auto test = MakeImage<short, 3>({ { 2, 2, 2 } }, { 1, 2, 3, 5, 6, 8, 9, 11 });
  const auto calculator = Compare(reference, test);

  const double withoutCorner = std::sqrt(45.0) + std::sqrt(40.0) + std::sqrt(13.0) + 6.0 + 3.0 + 2.0;
  EXPECT_DOUBLE_EQ(calculator->GetReferenceTotalVariation(), 7.0 + withoutCorner);
  EXPECT_DOUBLE_EQ(calculator->GetTestTotalVariation(), std::sqrt(1.0 + 4.0 + 25.0) + withoutCorner);
  EXPECT_DOUBLE_EQ(calculator->GetPeakSignalToNoiseRatio(), 10.0 * std::log10(121.0 * 8.0));
  EXPECT_DOUBLE_EQ(calculator->GetRelativeL2Error(), 1.0 / std::sqrt(340.0));
  EXPECT_EQ(calculator->GetRelativeErrorQuantiles()[0], 0.0);
  EXPECT_DOUBLE_EQ(calculator->GetRelativeErrorQuantiles()[1], 0.93 / 11.0);
  EXPECT_EQ(calculator->GetTestMinimum(), 1.0);
}

TEST(ImageFidelityCalculator, DividesByThePeakThatIsSet)
{
  const auto calculator = MakeCalculator(MakeImage<unsigned char, 2>({ { 2, 1 } }, { 10, 250 }),
                                         MakeImage<unsigned char, 2>({ { 2, 1 } }, { 250, 10 }));
  calculator->SetPeak(255.0);
  calculator->Update();
  EXPECT_EQ(calculator->GetEffectivePeak(), 255.0);
  EXPECT_DOUBLE_EQ(calculator->GetPeakSignalToNoiseRatio(), 20.0 * std::log10(255.0 / 240.0));
  EXPECT_DOUBLE_EQ(calculator->GetRelativeErrorQuantiles()[0], 240.0 / 255.0);

  calculator->SetPeak(0.0);
  calculator->Update();
  EXPECT_EQ(calculator->GetEffectivePeak(), 240.0);
  EXPECT_NEAR(calculator->GetPeakSignalToNoiseRatio(), 0.0, 1e-12);
}

TEST(ImageFidelityCalculator, WhereNeitherVariesTheRelativeTotalVariationIsOne)
{
  const auto constant = MakeImage<float, 2>({ { 3, 1 } }, { 2, 2, 2 });
  const auto other = MakeImage<float, 2>({ { 3, 1 } }, { 3, 3, 3 });
  const auto varying = MakeImage<float, 2>({ { 3, 1 } }, { 2, 2, 3 });
  const auto calculator = MakeCalculator(constant, other);
  calculator->SetPeak(1.0); // a constant has none
  calculator->Update();
  EXPECT_EQ(calculator->GetRelativeTotalVariation(), 1.0);
  calculator->SetTestImage(varying);
  calculator->Update();
  EXPECT_EQ(calculator->GetRelativeTotalVariation(), Infinity);
}

TEST(ImageFidelityCalculator, FindsEqualImagesEqual)
{
  const auto image = MakeImage<float, 2>({ { 3, 1 } }, { 1, 5, 2 });
  const auto calculator = Compare(image, image);
  EXPECT_EQ(calculator->GetPeakSignalToNoiseRatio(), Infinity);
  EXPECT_EQ(calculator->GetRelativeL2Error(), 0.0);
  EXPECT_EQ(calculator->GetRelativeErrorQuantiles(), (std::vector<double>{ 0.0, 0.0 }));
  EXPECT_EQ(calculator->GetRelativeTotalVariation(), 1.0);
}

TEST(ImageFidelityCalculator, ExcludesAndCountsNonFiniteVoxels)
{
  const auto calculator = Compare(MakeImage<double, 1>({ { 5 } }, { 0, 1, NaN, 3, 5 }),
                                  MakeImage<double, 1>({ { 5 } }, { 0, 2, 2, Infinity, 6 }));
  EXPECT_EQ(calculator->GetNumberOfExcludedVoxels(), 2u);
  EXPECT_EQ(calculator->GetNumberOfComparedVoxels(), 3u);
  EXPECT_EQ(calculator->GetEffectivePeak(), 5.0);
  EXPECT_EQ(calculator->GetTestMaximum(), 6.0);
  EXPECT_DOUBLE_EQ(calculator->GetRelativeL2Error(), std::sqrt(2.0 / 26.0));
  EXPECT_DOUBLE_EQ(calculator->GetPeakSignalToNoiseRatio(), 10.0 * std::log10(25.0 / (2.0 / 3.0)));
  EXPECT_DOUBLE_EQ(calculator->GetRelativeErrorQuantiles()[0], 0.2);
  EXPECT_EQ(calculator->GetReferenceTotalVariation(), 1.0);
  EXPECT_EQ(calculator->GetTestTotalVariation(), 2.0);
}

TEST(ImageFidelityCalculator, FollowsTheDefinitionsOnRandomImages)
{
  using Region2D = itk::ImageRegion<2>;
  using Region3D = itk::ImageRegion<3>;
  using Region4D = itk::ImageRegion<4>;
  ExpectDefinitions(MakeRandomImage<itk::Image<float, 1>>(itk::ImageRegion<1>({ { 5 } }, { { 301 } }), 1, 3.0),
                    MakeRandomImage<itk::Image<double, 1>>(itk::ImageRegion<1>({ { 5 } }, { { 301 } }), 2, 2.0),
                    false);
  ExpectDefinitions(MakeRandomImage<itk::Image<long, 2>>(Region2D({ { 0, -7 } }, { { 1, 83 } }), 3, 1e9),
                    MakeRandomImage<itk::Image<int, 2>>(Region2D({ { 0, -7 } }, { { 1, 83 } }), 4, 1e8),
                    false);
  ExpectDefinitions(MakeRandomImage<itk::Image<float, 4>>(Region4D(itk::Size<4>{ { 6, 5, 4, 3 } }), 5, 1.0),
                    MakeRandomImage<itk::Image<short, 4>>(Region4D(itk::Size<4>{ { 6, 5, 4, 3 } }), 6, 2.0),
                    false);

  const auto reference = MakeRandomImage<itk::Image<float, 3>>(Region3D({ { -3, 4, 11 } }, { { 33, 18, 7 } }), 7, 1e3);
  const auto test = MakeRandomImage<itk::Image<double, 3>>(Region3D({ { -3, 4, 11 } }, { { 33, 18, 7 } }), 8, 1e3);
  const double spacing[] = { 0.3, 2.0, 0.7 };
  reference->SetSpacing(spacing);
  test->SetSpacing(spacing);
  ExpectDefinitions(reference, test, false);
  reference->GetBufferPointer()[100] = std::numeric_limits<float>::quiet_NaN();
  reference->GetBufferPointer()[32] = -std::numeric_limits<float>::infinity();
  test->GetBufferPointer()[2000] = Infinity;
  test->GetBufferPointer()[2001] = NaN;
  ExpectDefinitions(reference, test, false);
  ExpectDefinitions(reference, test, true);
}

TEST(ImageFidelityCalculator, IsTheSameToTheByteForAnyNumberOfThreadsAndPieces)
{
  using InputType = itk::Image<float, 3>;
  const InputType::RegionType region({ { 2, -1, 5 } }, { { 37, 21, 23 } });
  const auto                  reference = MakeRandomImage<InputType>(region, 9, 100.0);
  const auto                  test = MakeRandomImage<InputType>(region, 10, 100.0);
  test->GetBufferPointer()[777] = std::numeric_limits<float>::quiet_NaN();
  const auto single = MakeCalculator(reference, test);
  single->SetNumberOfWorkUnits(1);
  single->Update();

  for (const unsigned int numberOfPieces : { 1u, 2u, 5u, 23u })
  {
    for (const unsigned int numberOfWorkUnits : { 1u, 2u, 7u, 64u })
    {
      const StreamingPipeline<InputType> pipeline(reference, test);
      pipeline.calculator->SetNumberOfStreamDivisions(numberOfPieces);
      pipeline.calculator->SetNumberOfWorkUnits(numberOfWorkUnits);
      pipeline.calculator->Update();
      EXPECT_TRUE(HaveSameBytes(GetFigures(pipeline.calculator), GetFigures(single)))
        << numberOfPieces << " pieces, " << numberOfWorkUnits << " work units";
    }
  }
}

TEST(ImageFidelityCalculator, NeverCutsRows)
{
  const auto expectSame = [](const auto & image, unsigned int numberOfUpdates) {
    using ImageType = std::decay_t<decltype(*image)>;
    const StreamingPipeline<ImageType> pipeline(image, image);
    pipeline.calculator->SetNumberOfStreamDivisions(3);
    pipeline.calculator->Update();
    EXPECT_EQ(pipeline.monitor->GetNumberOfUpdates(), numberOfUpdates);
    EXPECT_TRUE(HaveSameBytes(GetFigures(pipeline.calculator), GetFigures(Compare(image, image))));
  };
  using Image1D = itk::Image<float, 1>;
  using Image2D = itk::Image<float, 2>;
  expectSame(MakeRandomImage<Image1D>(Image1D::RegionType({ { 3 } }, { { 99 } }), 12, 1.0), 1);
  expectSame(MakeRandomImage<Image2D>(Image2D::RegionType({ { 3, 4 } }, { { 30, 9 } }), 13, 1.0),
             3 * itk::RadixQuantiles::NumberOfPasses);
}

TEST(ImageFidelityCalculator, AsksForOnePieceAndOneMoreSliceAtATime)
{
  using InputType = itk::Image<float, 3>;
  const InputType::RegionType        region({ { 2, -1, 5 } }, { { 7, 6, 10 } });
  const auto                         image = MakeRandomImage<InputType>(region, 11, 1.0);
  const StreamingPipeline<InputType> pipeline(image, image);
  pipeline.calculator->SetNumberOfStreamDivisions(3);
  pipeline.calculator->Update();

  const auto requests = pipeline.monitor->GetUpdatedRequestedRegions();
  ASSERT_EQ(requests.size(), 3 * itk::RadixQuantiles::NumberOfPasses);
  for (std::size_t i = 0; i < requests.size(); ++i)
  {
    const itk::IndexValueType firstSlices[] = { 5, 9, 13 };
    const itk::SizeValueType  numbersOfSlices[] = { 5, 5, 2 };
    EXPECT_EQ(requests[i],
              InputType::RegionType({ { 2, -1, firstSlices[i % 3] } }, { { 7, 6, numbersOfSlices[i % 3] } }));
  }
}

TEST(ImageFidelityCalculator, RefusesImagesThatCannotBeCompared)
{
  using ImageType = itk::Image<float, 2>;
  const auto reference = MakeImage<float, 2>({ { 2, 2 } }, { 0, 1, 2, 3 });
  const auto expectError = [&reference](const ImageType::Pointer & test, const std::string & words) {
    EXPECT_NE(GetErrorOfUpdate(MakeCalculator(reference, test)).find(words), std::string::npos) << words;
  };
  expectError(MakeImage<float, 2>({ { 4, 1 } }, { 0, 1, 2, 3 }), "differ in region");
  expectError(MakeRandomImage<ImageType>(ImageType::RegionType({ { 1, 0 } }, { { 2, 2 } }), 1, 1.0),
              "differ in region");

  const auto   moved = MakeImage<float, 2>({ { 2, 2 } }, { 0, 1, 2, 3 });
  const double origin[] = { 0.0, 0.01 };
  moved->SetOrigin(origin);
  expectError(moved, "physical space");
  const auto   stretched = MakeImage<float, 2>({ { 2, 2 } }, { 0, 1, 2, 3 });
  const double spacing[] = { 1.0, 1.01 };
  stretched->SetSpacing(spacing);
  expectError(stretched, "physical space");
  const auto               turned = MakeImage<float, 2>({ { 2, 2 } }, { 0, 1, 2, 3 });
  ImageType::DirectionType direction;
  direction(0, 1) = 1.0;
  direction(1, 0) = -1.0;
  turned->SetDirection(direction);
  expectError(turned, "physical space");

  const float nan = std::numeric_limits<float>::quiet_NaN();
  expectError(MakeImage<float, 2>({ { 2, 2 } }, { nan, nan, nan, nan }), "no voxel");
  expectError(nullptr, "TestImage");
}

TEST(ImageFidelityCalculator, RefusesImagesWithoutVoxels)
{
  const auto image = MakeImage<float, 2>({ { 0, 3 } }, {});
  EXPECT_NE(GetErrorOfUpdate(MakeCalculator(image, image)).find("no voxels"), std::string::npos);
}

TEST(ImageFidelityCalculator, RefusesSettingsThatMakeNoSense)
{
  const auto image = MakeImage<float, 2>({ { 2, 2 } }, { 0, 1, 2, 3 });
  const auto calculator = MakeCalculator(image, image);
  for (const double peak : { -1.0, NaN, Infinity })
  {
    calculator->SetPeak(peak);
    EXPECT_NE(GetErrorOfUpdate(calculator).find("peak"), std::string::npos) << peak;
  }
  calculator->SetPeak(0.0);
  for (const double level : { -0.01, 1.01, NaN })
  {
    calculator->SetQuantileLevels({ 0.5, level });
    EXPECT_NE(GetErrorOfUpdate(calculator).find("level"), std::string::npos) << level;
  }
}

TEST(ImageFidelityCalculator, AsksForAPeakWhereTheReferenceIsConstant)
{
  const auto calculator =
    MakeCalculator(MakeImage<float, 1>({ { 2 } }, { 2, 2 }), MakeImage<float, 1>({ { 2 } }, { 2, 4 }));
  EXPECT_NE(GetErrorOfUpdate(calculator).find("set the peak"), std::string::npos);
  EXPECT_TRUE(std::isnan(calculator->GetPeakSignalToNoiseRatio()));

  calculator->SetPeak(4.0);
  calculator->Update();
  EXPECT_DOUBLE_EQ(calculator->GetPeakSignalToNoiseRatio(), 10.0 * std::log10(16.0 / 2.0));
  EXPECT_DOUBLE_EQ(calculator->GetRelativeErrorQuantiles()[0], 0.25);
  EXPECT_EQ(calculator->GetRelativeTotalVariation(), Infinity);
}

TEST(ImageFidelityCalculator, RecoversAfterAnInputFailed)
{
  const auto source = UnreliableSource::New();
  const auto calculator = MakeCalculator(MakeImage<float, 2>({ { 2, 2 } }, { 0, 1, 2, 3 }),
                                         itk::SmartPointer<itk::Image<double, 2>>(source->GetOutput()));
  EXPECT_NE(GetErrorOfUpdate(calculator).find("source failed"), std::string::npos);
  EXPECT_TRUE(std::isnan(calculator->GetTestMinimum()));

  source->fails = false;
  EXPECT_EQ(GetErrorOfUpdate(calculator), "no error");
  EXPECT_EQ(calculator->GetTestMinimum(), 1.0);
  EXPECT_DOUBLE_EQ(calculator->GetRelativeL2Error(), std::sqrt(6.0 / 14.0));
}

TEST(ImageFidelityCalculator, PrintsItself)
{
  const auto         image = MakeImage<float, 2>({ { 2, 2 } }, { 0, 1, 2, 3 });
  std::ostringstream text;
  Compare(image, image)->Print(text);
  EXPECT_NE(text.str().find("ImageFidelityCalculator"), std::string::npos);
  EXPECT_NE(text.str().find("RelativeL2Error: 0"), std::string::npos);
}
