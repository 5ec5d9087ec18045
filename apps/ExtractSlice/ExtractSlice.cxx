// SPDX-License-Identifier: Apache-2.0
// ExtractSlice INPUT OUTPUT: writes the middle slice of a volume, or of the first volume of a series in time, as float.
// INPUT is an image file or a folder with a DICOM series.

#include "InputImage.h"

#include "itkExtractImageFilter.h"
#include "itkImageFileWriter.h"
#include "itkImageSeriesReader.h"

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
    using ImageType = itk::Image<float, 3>;
    const InputImage input = OpenInput(argv[1], "");
    const auto       reader = itk::ImageSeriesReader<ImageType>::New();
    reader->SetImageIO(input.ImageIO);
    reader->SetFileNames(input.FileNames);
    reader->UpdateOutputInformation();

    ImageType::RegionType region = reader->GetOutput()->GetLargestPossibleRegion();
    region.SetIndex(2, region.GetIndex(2) + static_cast<itk::IndexValueType>(region.GetSize(2) / 2));
    region.SetSize(2, 1);
    const auto slice = itk::ExtractImageFilter<ImageType, ImageType>::New();
    slice->SetInput(reader->GetOutput());
    slice->SetExtractionRegion(region);

    const auto writer = itk::ImageFileWriter<ImageType>::New();
    writer->SetInput(slice->GetOutput());
    writer->SetFileName(argv[2]);
    writer->Update();
  }
  catch (const itk::ExceptionObject & error)
  {
    std::cerr << "ExtractSlice: " << error.GetDescription() << '\n';
    return 1;
  }
  catch (const std::exception & error)
  {
    std::cerr << "ExtractSlice: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
