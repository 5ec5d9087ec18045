// SPDX-License-Identifier: Apache-2.0
#include "itkLabelSubdivisionImageFilter.h"

#include "itkImageRegionConstIterator.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkStreamingImageFilter.h"
#include "itkGTest.h"

#include <set>

namespace
{

using ImageType = itk::Image<short, 3>;
using FilterType = itk::LabelSubdivisionImageFilter<ImageType>;

/** Labels -3, 0 and 700: a ball and a slab in a background, from an index of its own. */
ImageType::Pointer
MakeLabels()
{
  const auto            image = ImageType::New();
  ImageType::RegionType region;
  region.SetIndex({ { -4, 2, 7 } });
  region.SetSize({ { 31, 24, 20 } });
  image->SetRegions(region);
  image->Allocate();
  const double spacing[] = { 0.5, 1.0, 2.0 };
  image->SetSpacing(spacing);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, region); !it.IsAtEnd(); ++it)
  {
    const auto index = it.GetIndex();
    const auto x = index[0] - 9;
    const auto y = index[1] - 13;
    const auto z = index[2] - 16;
    it.Set(x * x + y * y + z * z < 50 ? 700 : index[1] < 6 ? -3 : 0);
  }
  return image;
}

template <typename TImage>
std::vector<typename TImage::PixelType>
GetPixels(const TImage * const image)
{
  std::vector<typename TImage::PixelType> pixels;
  for (itk::ImageRegionConstIterator<TImage> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    pixels.push_back(it.Get());
  }
  return pixels;
}

TEST(LabelSubdivisionImageFilter, KeepsLabelsGeometryAndDefaults)
{
  const auto labels = MakeLabels();
  const auto filter = FilterType::New();
  EXPECT_EQ(filter->GetScheme(), FilterType::SchemeEnum::Restored);
  EXPECT_EQ(filter->GetTension(), 0.0);
  filter->SetInput(labels);
  filter->Update();
  const auto * const output = filter->GetOutput();
  EXPECT_EQ(output->GetBufferedRegion().GetIndex(), (ImageType::IndexType{ { -8, 4, 14 } }));
  EXPECT_EQ(output->GetBufferedRegion().GetSize(), (ImageType::SizeType{ { 62, 48, 40 } }));
  const double spacing[] = { 0.25, 0.5, 1.0 };
  EXPECT_EQ(output->GetSpacing(), ImageType::SpacingType(spacing));
  const auto            pixels = GetPixels(output);
  const std::set<short> found(pixels.begin(), pixels.end());
  EXPECT_EQ(found, (std::set<short>{ -3, 0, 700 }));
}

TEST(LabelSubdivisionImageFilter, StreamsToTheSameLabels)
{
  const auto labels = MakeLabels();
  const auto whole = FilterType::New();
  whole->SetInput(labels);
  whole->Update();

  const auto filter = FilterType::New();
  filter->SetInput(labels);
  filter->SetNumberOfWorkUnits(3);
  const auto streamer = itk::StreamingImageFilter<ImageType, ImageType>::New();
  streamer->SetInput(filter->GetOutput());
  streamer->SetNumberOfStreamDivisions(7);
  streamer->Update();
  EXPECT_EQ(GetPixels(streamer->GetOutput()), GetPixels(whole->GetOutput()));
}

TEST(LabelSubdivisionImageFilter, RefusesOtherSchemesAndLabelsThatDoNotFit)
{
  const auto filter = FilterType::New();
  filter->SetInput(MakeLabels());
  filter->SetScheme(FilterType::SchemeEnum::NonOscillatory);
  filter->SetTension(2.0);
  EXPECT_THROW(filter->Update(), itk::ExceptionObject);

  for (const char * const scheme : { "bspline", "linear" })
  {
    const auto smooth = FilterType::New();
    smooth->SetInput(MakeLabels());
    smooth->SetSchemeByName(scheme);
    EXPECT_NO_THROW(smooth->Update()) << scheme;
  }

  const auto narrow = itk::LabelSubdivisionImageFilter<ImageType, itk::Image<signed char, 3>>::New();
  narrow->SetInput(MakeLabels());
  EXPECT_THROW(narrow->Update(), itk::ExceptionObject);
}

} // namespace
