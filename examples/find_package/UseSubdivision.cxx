// SPDX-License-Identifier: Apache-2.0
// Subdivides a step along one axis and prints it: a monotone ramp, from 0 to 1.

#include "itkImage.h"
#include "itkNonOscillatorySubdivisionImageFilter.h"

#include <iostream>

int
main()
{
  using ImageType = itk::Image<float, 1>;
  const auto image = ImageType::New();
  image->SetRegions(ImageType::SizeType{ { 10 } });
  image->Allocate();
  for (int i = 0; i < 10; ++i)
  {
    image->SetPixel({ { i } }, i < 5 ? 0.0f : 1.0f);
  }

  const auto filter = itk::NonOscillatorySubdivisionImageFilter<ImageType>::New();
  filter->SetInput(image);
  filter->Update();
  for (int m = 0; m < 20; ++m)
  {
    std::cout << filter->GetOutput()->GetPixel({ { m } }) << '\n';
  }
  return 0;
}
