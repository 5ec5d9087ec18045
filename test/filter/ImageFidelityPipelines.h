// SPDX-License-Identifier: Apache-2.0
#ifndef ImageFidelityPipelines_h
#define ImageFidelityPipelines_h

#include "itkCastImageFilter.h"
#include "itkImageFidelityCalculator.h"
#include "itkImageSource.h"
#include "itkPipelineMonitorImageFilter.h"

/** Casts both images to double; the filters in between hold no more of them than was asked for. */
template <typename TImage>
struct StreamingPipeline
{
  using RealType = itk::Image<double, TImage::ImageDimension>;
  using CastType = itk::CastImageFilter<TImage, RealType>;
  using MonitorType = itk::PipelineMonitorImageFilter<RealType>;
  using CalculatorType = itk::ImageFidelityCalculator<RealType>;

  typename CastType::Pointer       castReference{ CastType::New() };
  typename CastType::Pointer       castTest{ CastType::New() };
  typename MonitorType::Pointer    monitor{ MonitorType::New() };
  typename CalculatorType::Pointer calculator{ CalculatorType::New() };

  StreamingPipeline(const TImage * reference, const TImage * test)
  {
    castReference->SetInput(reference);
    castTest->SetInput(test);
    monitor->SetInput(castTest->GetOutput());
    calculator->SetReferenceImage(castReference->GetOutput());
    calculator->SetTestImage(monitor->GetOutput());
  }
};

/** Fails in the pipeline until it is told not to. */
class UnreliableSource : public itk::ImageSource<itk::Image<double, 2>>
{
public:
  using Self = UnreliableSource;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);

  bool fails{ true };

protected:
  void
  GenerateOutputInformation() override
  {
    this->GetOutput()->SetLargestPossibleRegion(itk::ImageRegion<2>(itk::Size<2>{ { 2, 2 } }));
  }

  void
  GenerateData() override
  {
    if (fails)
    {
      itkExceptionMacro("The source failed.");
    }
    this->AllocateOutputs();
    this->GetOutput()->FillBuffer(1.0);
  }
};

#endif
