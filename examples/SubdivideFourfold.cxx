// SPDX-License-Identifier: Apache-2.0

// Four times the resolution: the filter twice in a pipeline, with real values between, so that nothing is rounded
// before the end. The pipeline streams through both.
//
//   SubdivideFourfold INPUT OUTPUT

#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"
#include "itkNonOscillatorySubdivisionImageFilter.h"

#include <cstdlib>
#include <iostream>

int
main(int argc, char * argv[])
{
  if (argc != 3)
  {
    std::cerr << "usage: " << argv[0] << " INPUT OUTPUT" << std::endl;
    return EXIT_FAILURE;
  }
  using ImageType = itk::Image<short, 3>;
  using RealImageType = itk::Image<float, 3>; // double for pixels of 32 bits and more

  const auto reader = itk::ImageFileReader<ImageType>::New();
  reader->SetFileName(argv[1]);

  // Each filter applies the scheme, the tension and the boundary condition to its own input.
  const auto first = itk::NonOscillatorySubdivisionImageFilter<ImageType, RealImageType>::New();
  first->SetInput(reader->GetOutput());
  const auto second = itk::NonOscillatorySubdivisionImageFilter<RealImageType, ImageType>::New();
  second->SetInput(first->GetOutput());

  const auto writer = itk::ImageFileWriter<ImageType>::New();
  writer->SetInput(second->GetOutput());
  writer->SetFileName(argv[2]);
  writer->SetNumberOfStreamDivisions(16);
  try
  {
    writer->Update();
  }
  catch (const itk::ExceptionObject & error)
  {
    std::cerr << error << std::endl;
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
