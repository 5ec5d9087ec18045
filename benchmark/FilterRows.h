// SPDX-License-Identifier: Apache-2.0
#ifndef FilterRows_h
#define FilterRows_h

#include "BenchmarkRow.h"
#include "NonOscillatorySubdivision/Target.h"
#include "TestVolume.h"

#include "itkBSplineInterpolateImageFunction.h"
#include "itkExpandImageFilter.h"
#include "itkLinearInterpolateImageFunction.h"
#include "itkNearestNeighborInterpolateImageFunction.h"
#include "itkNonOscillatorySubdivisionImageFilter.h"
#include "itkResampleImageFilter.h"
#include "itkWindowedSincInterpolateImageFunction.h"

#include <vector>

namespace subdivision_benchmark
{

/** Wraps an ITK filter whose input is set. One work unit a thread makes ITK keep to the threads asked for. */
template <typename TFilter>
PreparedUpdate
PrepareFilter(const itk::SmartPointer<TFilter> & filter, const Workload & workload)
{
  filter->SetNumberOfWorkUnits(workload.Threads);

  const auto update = [filter]() {
    filter->Modified();
    filter->Update();
  };
  const auto touchOutput = [filter]() {
    filter->UpdateOutputInformation();
    const auto output = filter->GetOutput();
    output->SetBufferedRegion(output->GetLargestPossibleRegion());
    output->Allocate();
    output->FillBuffer(0);
  };
  return { update, touchOutput };
}

/** The module's filter. `target` is the kernel's instruction set; the empty name stands for the fastest. */
template <typename TImage>
BenchmarkRow
SubdivisionRow(const std::string &                                    name,
               itk::NonOscillatorySubdivisionImageFilterEnums::Scheme scheme,
               double                                                 laneOperationsPerVoxel,
               const std::string &                                    target = "")
{
  const auto prepare = [scheme, target](const Workload & workload) {
    const auto filter = itk::NonOscillatorySubdivisionImageFilter<TImage>::New();
    filter->SetInput(GetTestVolume<typename TImage::PixelType>(workload.Size));
    filter->SetScheme(scheme);
    filter->SetTarget(target);
    return PrepareFilter(filter, workload);
  };
  return { name, prepare, false, laneOperationsPerVoxel };
}

template <typename TImage>
typename itk::ExpandImageFilter<TImage, TImage>::Pointer
MakeExpandFilter(unsigned int size)
{
  const auto filter = itk::ExpandImageFilter<TImage, TImage>::New();
  filter->SetInput(GetTestVolume<typename TImage::PixelType>(size));
  filter->SetExpandFactors(2);
  return filter;
}

template <typename TImage, template <typename, typename> class TInterpolator>
BenchmarkRow
ExpandRow(const std::string & name)
{
  const auto prepare = [](const Workload & workload) {
    const auto filter = MakeExpandFilter<TImage>(workload.Size);
    filter->SetInterpolator(TInterpolator<TImage, double>::New());
    return PrepareFilter(filter, workload);
  };
  return { name, prepare };
}

/** Resampling onto the output grid of ExpandImageFilter, which covers the same physical box as the input. */
template <typename TImage>
PreparedUpdate
PrepareResample(itk::InterpolateImageFunction<TImage, double> * interpolator,
                const Workload &                                workload,
                const TImage *                                  input)
{
  const auto expand = MakeExpandFilter<TImage>(workload.Size);
  expand->UpdateOutputInformation();
  const TImage * grid = expand->GetOutput();

  const auto filter = itk::ResampleImageFilter<TImage, TImage>::New();
  filter->SetInput(input);
  filter->SetOutputOrigin(grid->GetOrigin());
  filter->SetOutputSpacing(grid->GetSpacing());
  filter->SetOutputDirection(grid->GetDirection());
  filter->SetOutputStartIndex(grid->GetLargestPossibleRegion().GetIndex());
  filter->SetSize(grid->GetLargestPossibleRegion().GetSize());
  filter->SetInterpolator(interpolator);
  return PrepareFilter(filter, workload);
}

template <typename TImage>
BenchmarkRow
ResampleLinearRow()
{
  const auto prepare = [](const Workload & workload) {
    return PrepareResample<TImage>(itk::LinearInterpolateImageFunction<TImage, double>::New(),
                                   workload,
                                   GetTestVolume<typename TImage::PixelType>(workload.Size));
  };
  return { "ResampleLinear", prepare };
}

template <typename TImage>
BenchmarkRow
ResampleBSplineRow(unsigned int order)
{
  const auto prepare = [order](const Workload & workload) {
    const auto interpolator = itk::BSplineInterpolateImageFunction<TImage, double, double>::New();
    interpolator->SetSplineOrder(order);
    return PrepareResample<TImage>(interpolator, workload, GetTestVolume<typename TImage::PixelType>(workload.Size));
  };
  return { "ResampleBSpline" + std::to_string(order), prepare, true };
}

template <typename TImage>
BenchmarkRow
ResampleWindowedSincRow()
{
  constexpr unsigned int radius = 3;
  using InterpolatorType =
    itk::WindowedSincInterpolateImageFunction<TImage, radius, itk::Function::LanczosWindowFunction<radius>>;

  const auto prepare = [](const Workload & workload) {
    return PrepareResample<TImage>(
      InterpolatorType::New(), workload, GetTestVolume<typename TImage::PixelType>(workload.Size));
  };
  return { "ResampleLanczos3", prepare, true };
}

/** Every filter of the comparison for one pixel type: the schemes, and what a user would pick instead. */
template <typename TPixel>
std::vector<BenchmarkRow>
MakeFilterRows(bool withWindowedSinc)
{
  using ImageType = itk::Image<TPixel, 3>;
  using Scheme = itk::NonOscillatorySubdivisionImageFilterEnums::Scheme;

  // The fewest lane operations an input voxel. The linear scheme: 6 taps for each of the 2, 4 and 8 values that the
  // passes along z, y and x make. The bound: minimum and maximum of 3 along 3 axes, and a clamp of 8 children. The
  // non-oscillatory scheme: 7 thresholded fields (about 100 operations), then 10 taps for each of 8 values a pass. The
  // restored scheme: the linear passes twice, P f (2 Laplacians of 7 taps), the bound, T (6 differences, least and
  // greatest of 5 along 3 axes) and a second clamp of 8 children.
  constexpr double linear = 6 * (2 + 4 + 8);
  constexpr double bound = 2 * 2 * 3 + 2 * 8;
  constexpr double nonOscillatory = 100 + 10 * (8 + 8 + 8);
  constexpr double restored = 2 * linear + 2 * 7 + bound + 3 * 6 + 2 * 4 * 3 + 3 * 8;

  std::vector<BenchmarkRow> rows{ SubdivisionRow<ImageType>("NonOscillatory", Scheme::NonOscillatory, nonOscillatory),
                                  SubdivisionRow<ImageType>("Linear", Scheme::Linear, linear),
                                  SubdivisionRow<ImageType>("BoundedLinear", Scheme::BoundedLinear, linear + bound),
                                  SubdivisionRow<ImageType>("BSpline", Scheme::BSpline, linear),
                                  SubdivisionRow<ImageType>("Restored", Scheme::Restored, restored),
                                  ExpandRow<ImageType, itk::LinearInterpolateImageFunction>("ExpandLinear"),
                                  ExpandRow<ImageType, itk::NearestNeighborInterpolateImageFunction>("ExpandNearest"),
                                  ResampleLinearRow<ImageType>(),
                                  ResampleBSplineRow<ImageType>(3),
                                  ResampleBSplineRow<ImageType>(5) };
  if (withWindowedSinc)
  {
    rows.push_back(ResampleWindowedSincRow<ImageType>());
  }
  for (const std::string & target : itk::Subdivision::Target::GetNames())
  {
    if (target != itk::Subdivision::Target::Fastest().GetName())
    {
      rows.push_back(
        SubdivisionRow<ImageType>("NonOscillatory@" + target, Scheme::NonOscillatory, nonOscillatory, target));
    }
  }
  return rows;
}

} // namespace subdivision_benchmark

#endif
