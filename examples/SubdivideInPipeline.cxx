// SPDX-License-Identifier: Apache-2.0
// The filter in an ITK pipeline: reads a volume, doubles its resolution, writes it.

#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"
#include "itkNonOscillatorySubdivisionImageFilter.h"

#include <iostream>

int
main(int argc, char * argv[])
{
  if (argc != 3)
  {
    std::cerr << "Usage: " << argv[0] << " INPUT OUTPUT\n";
    return 2;
  }
  try
  {
    using ImageType = itk::Image<short, 3>;
    const auto reader = itk::ImageFileReader<ImageType>::New();
    reader->SetFileName(argv[1]);

    const auto filter = itk::NonOscillatorySubdivisionImageFilter<ImageType>::New();
    filter->SetInput(reader->GetOutput());
    filter->SetTension(2.0); // closer to the linear scheme with a larger one

    const auto writer = itk::ImageFileWriter<ImageType>::New();
    writer->SetInput(filter->GetOutput());
    writer->SetFileName(argv[2]);
    writer->SetNumberOfStreamDivisions(8); // 8 pieces, if the formats can be read and written so
    writer->Update();
  }
  catch (const itk::ExceptionObject & error)
  {
    std::cerr << error << '\n';
    return 1;
  }
  return 0;
}
