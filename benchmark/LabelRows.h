// SPDX-License-Identifier: Apache-2.0
#ifndef LabelRows_h
#define LabelRows_h

#include "FilterRows.h"
#include "TestLabels.h"

#include "itkLabelImageGaussianInterpolateImageFunction.h"
#include "itkLabelSubdivisionImageFilter.h"

#include <type_traits>

namespace subdivision_benchmark
{

/** A filter of the module on the label map, with its own defaults. */
template <typename TFilter>
BenchmarkRow
LabelMapRow(const std::string & name)
{
  const auto prepare = [](const Workload & workload) {
    const auto filter = TFilter::New();
    filter->SetInput(GetTestLabels<typename TFilter::InputImageType::PixelType>(workload.Size));
    return PrepareFilter(filter, workload);
  };
  return { name, prepare };
}

template <typename TImage>
BenchmarkRow
ResampleLabelGaussianRow()
{
  const auto prepare = [](const Workload & workload) {
    return PrepareResample<TImage>(itk::LabelImageGaussianInterpolateImageFunction<TImage, double>::New(),
                                   workload,
                                   GetTestLabels<typename TImage::PixelType>(workload.Size));
  };
  return { "ResampleLabelGaussian", prepare, true };
}

/** The rows of a label map: none for real pixels. */
template <typename TPixel>
std::vector<BenchmarkRow>
MakeLabelRows(bool withAllPeers)
{
  using ImageType = itk::Image<TPixel, 3>;
  std::vector<BenchmarkRow> rows;
  if constexpr (std::is_integral<TPixel>::value)
  {
    rows.push_back(LabelMapRow<itk::LabelSubdivisionImageFilter<ImageType>>("LabelMap"));
    rows.push_back(LabelMapRow<itk::NonOscillatorySubdivisionImageFilter<ImageType>>("NonOscillatoryOfLabelMap"));
    if (withAllPeers)
    {
      rows.push_back(ResampleLabelGaussianRow<ImageType>());
    }
  }
  return rows;
}

} // namespace subdivision_benchmark

#endif
