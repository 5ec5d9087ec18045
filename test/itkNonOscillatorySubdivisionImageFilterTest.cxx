// SPDX-License-Identifier: Apache-2.0
// Subdivides an image file, to be compared with a baseline by ITK's test driver.

#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"
#include "itkMirrorBoundaryCondition.h"
#include "itkNonOscillatorySubdivisionImageFilter.h"
#include "itkPeriodicBoundaryCondition.h"
#include "itkTestingMacros.h"

#include <map>

namespace
{

struct Arguments
{
  std::string input;
  std::string output;
  std::string scheme;
  std::string boundary;
  std::string axes;
};

itk::NonOscillatorySubdivisionImageFilterEnums::Scheme
SchemeNamed(const std::string & name)
{
  using SchemeEnum = itk::NonOscillatorySubdivisionImageFilterEnums::Scheme;
  const std::map<std::string, SchemeEnum> schemes{ { "nonoscillatory", SchemeEnum::NonOscillatory },
                                                   { "linear", SchemeEnum::Linear },
                                                   { "bounded", SchemeEnum::BoundedLinear },
                                                   { "bspline", SchemeEnum::BSpline } };
  return schemes.at(name);
}

template <typename TInputImage, typename TOutputImage>
int
SubdivideFile(const Arguments & arguments)
{
  using FilterType = itk::NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>;
  constexpr unsigned int D = TInputImage::ImageDimension;

  itk::MirrorBoundaryCondition<TInputImage>   mirror;
  itk::PeriodicBoundaryCondition<TInputImage> periodic;
  itk::FixedArray<bool, D>                    axes;
  for (unsigned int w = 0; w < D; ++w)
  {
    axes[w] = arguments.axes.find("xyz"[w]) != std::string::npos;
  }

  auto reader = itk::ImageFileReader<TInputImage>::New();
  reader->SetFileName(arguments.input);
  auto filter = FilterType::New();
  filter->SetInput(reader->GetOutput());
  filter->SetScheme(SchemeNamed(arguments.scheme));
  filter->SetSubdividedAxes(axes);
  if (arguments.boundary == "mirror")
  {
    filter->SetBoundaryCondition(&mirror);
  }
  else if (arguments.boundary == "periodic")
  {
    filter->SetBoundaryCondition(&periodic);
  }

  auto writer = itk::ImageFileWriter<TOutputImage>::New();
  writer->SetInput(filter->GetOutput());
  writer->SetFileName(arguments.output);
  writer->SetNumberOfStreamDivisions(3);
  ITK_TRY_EXPECT_NO_EXCEPTION(writer->Update());
  return EXIT_SUCCESS;
}

} // namespace

int
itkNonOscillatorySubdivisionImageFilterTest(int argc, char * argv[])
{
  if (argc != 7)
  {
    std::cerr << "Usage: " << itkNameOfTestExecutableMacro(argv)
              << " slice|volume input output nonoscillatory|linear|bounded|bspline zeroflux|mirror|periodic axes\n"
                 "A slice is of unsigned char and stays so; a volume is of short and becomes float.\n";
    return EXIT_FAILURE;
  }
  const Arguments arguments{ argv[2], argv[3], argv[4], argv[5], argv[6] };
  if (std::string(argv[1]) == "slice")
  {
    using Slice = itk::Image<unsigned char, 2>;
    return SubdivideFile<Slice, Slice>(arguments);
  }
  return SubdivideFile<itk::Image<short, 3>, itk::Image<float, 3>>(arguments);
}
