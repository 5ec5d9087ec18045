// SPDX-License-Identifier: Apache-2.0
// Whether the filter's output has the very bytes that it once had: one hash a run, of all schemes along one to three
// axes, on several sizes, boundaries and pixel types, by the portable kernel, which is the same on every machine.
//   GoldenBytes HASHES     compares with a file of such lines; names each line that differs
//   GoldenBytes --print    writes the lines

#include "common/GreyValues.h"

#include "itkConstantBoundaryCondition.h"
#include "itkImage.h"
#include "itkMirrorBoundaryCondition.h"
#include "itkNonOscillatorySubdivisionImageFilter.h"
#include "itkPeriodicBoundaryCondition.h"
#include "itkRGBPixel.h"
#include "itkZeroFluxNeumannBoundaryCondition.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace
{

using Scheme = itk::NonOscillatorySubdivisionImageFilterEnums::Scheme;
using Size3 = itk::Size<3>;

const std::vector<std::pair<Scheme, std::string>> Schemes{ { Scheme::NonOscillatory, "nonoscillatory" },
                                                           { Scheme::Linear, "linear" },
                                                           { Scheme::BoundedLinear, "bounded" },
                                                           { Scheme::BSpline, "bspline" } };

constexpr std::uint64_t EmptyHash = 14695981039346656037u;

/** FNV-1a, of what was hashed before and of more bytes. */
std::uint64_t
Hash(std::uint64_t hash, const void * const bytes, const std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    hash = (hash ^ static_cast<const unsigned char *>(bytes)[i]) * 1099511628211u;
  }
  return hash;
}

template <typename TComponent>
TComponent
Component(const std::uint64_t position)
{
  const std::uint64_t sample = GetGreyValue(position);
  if constexpr (std::is_floating_point<TComponent>::value)
  {
    return static_cast<TComponent>(static_cast<double>(sample) / 1000.0 - 20.0);
  }
  else
  {
    // The upper half of the range first, and every bit of wide integers.
    constexpr int width = static_cast<int>(8 * sizeof(TComponent));
    const auto wide = width > 16 ? sample << (width - 16) | Scramble(position) >> (80 - width) : sample >> (16 - width);
    return static_cast<TComponent>(wide);
  }
}

template <typename TImage>
typename TImage::Pointer
MakeInput(const Size3 & size)
{
  using ComponentType = typename itk::NumericTraits<typename TImage::PixelType>::ValueType;
  typename TImage::RegionType region;
  for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
  {
    region.SetIndex(axis, 3 - 4 * static_cast<itk::IndexValueType>(axis));
    region.SetSize(axis, size[axis]);
  }
  const auto image = TImage::New();
  image->SetRegions(region);
  image->Allocate();
  auto * const      components = reinterpret_cast<ComponentType *>(image->GetBufferPointer());
  const std::size_t count = region.GetNumberOfPixels() * image->GetNumberOfComponentsPerPixel();
  for (std::size_t i = 0; i < count; ++i)
  {
    components[i] = Component<ComponentType>(i);
  }
  return image;
}

/** Runs every scheme along the given axes. A line holds for all boundaries, one after the other, the mirrored one with
 * a small tension. */
template <typename TInputImage, typename TOutputImage>
void
Print(std::ostream & out, const std::string & types, const Size3 & size, const unsigned int axes)
{
  itk::ZeroFluxNeumannBoundaryCondition<TInputImage, TInputImage> zeroFlux;
  itk::MirrorBoundaryCondition<TInputImage, TInputImage>          mirror;
  itk::PeriodicBoundaryCondition<TInputImage, TInputImage>        periodic;
  itk::ConstantBoundaryCondition<TInputImage, TInputImage>        constant;
  using BoundaryPointer = itk::ImageBoundaryCondition<TInputImage, TInputImage> *;
  const std::vector<BoundaryPointer> boundaries{ &zeroFlux, &mirror, &periodic, &constant };

  itk::FixedArray<bool, TInputImage::ImageDimension> subdivided;
  std::string                                        letters;
  for (unsigned int axis = 0; axis < TInputImage::ImageDimension; ++axis)
  {
    subdivided[axis] = axes >> axis & 1;
    letters += subdivided[axis] ? std::string(1, "xyz"[axis]) : "";
  }
  const auto input = MakeInput<TInputImage>(size);
  for (const auto & [scheme, name] : Schemes)
  {
    std::uint64_t hash = EmptyHash;
    for (const BoundaryPointer boundary : boundaries)
    {
      const auto filter = itk::NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::New();
      filter->SetInput(input);
      filter->SetScheme(scheme);
      filter->SetTension(boundary == &mirror ? 1.25 : 2.0);
      filter->SetSubdividedAxes(subdivided);
      filter->SetBoundaryCondition(boundary);
      filter->SetTarget("portable");
      filter->Update();
      const auto * const output = filter->GetOutput();
      const auto         pixels = output->GetBufferedRegion().GetNumberOfPixels();
      hash = Hash(hash, output->GetBufferPointer(), pixels * sizeof(typename TOutputImage::PixelType));
    }
    out << types << ' ' << name << ' ' << letters << ' ' << size[0] << 'x' << size[1] << 'x' << size[2] << ' '
        << std::hex << std::setw(16) << std::setfill('0') << hash << std::dec << '\n';
  }
}

template <typename TInput, typename TOutput>
void
PrintVolumes(std::ostream & out, const std::string & types)
{
  using InputImage = itk::Image<TInput, 3>;
  using OutputImage = itk::Image<TOutput, 3>;
  for (unsigned int axes = 1; axes < 8; ++axes)
  {
    for (const Size3 & size : { Size3{ { 1, 1, 1 } }, Size3{ { 7, 5, 4 } }, Size3{ { 67, 13, 21 } } })
    {
      Print<InputImage, OutputImage>(out, types, size, axes);
    }
  }
  // Several tiles along each axis.
  Print<InputImage, OutputImage>(out, types, { { 523, 9, 7 } }, 7);
  Print<InputImage, OutputImage>(out, types, { { 12, 90, 80 } }, 7);
}

std::string
PrintAll()
{
  std::ostringstream out;
  PrintVolumes<unsigned char, unsigned char>(out, "uint8");
  PrintVolumes<short, short>(out, "int16");
  PrintVolumes<unsigned short, unsigned short>(out, "uint16");
  PrintVolumes<unsigned short, float>(out, "uint16-float");
  PrintVolumes<float, float>(out, "float");
  PrintVolumes<double, double>(out, "double");
  PrintVolumes<double, unsigned char>(out, "double-uint8");
  PrintVolumes<int, int>(out, "int32");
  PrintVolumes<itk::RGBPixel<unsigned char>, itk::RGBPixel<unsigned char>>(out, "rgb8");
  for (const itk::SizeValueType width : { 1, 2, 31, 255, 256, 257, 1025 })
  {
    Print<itk::Image<float, 1>, itk::Image<float, 1>>(out, "float-line", { { width, 1, 1 } }, 1);
    Print<itk::Image<double, 2>, itk::Image<double, 2>>(out, "double-slice", { { width, 6, 1 } }, 3);
  }
  return out.str();
}

std::vector<std::string>
Lines(std::istream & text)
{
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);)
  {
    lines.push_back(line);
  }
  return lines;
}

} // namespace

int
main(const int argc, char ** const argv)
{
  if (argc != 2)
  {
    std::cerr << "usage: GoldenBytes HASHES|--print\n";
    return 2;
  }
  try
  {
    const std::string printed = PrintAll();
    if (argv[1] == std::string("--print"))
    {
      std::cout << printed;
      return 0;
    }
    std::ifstream                  file(argv[1]);
    std::istringstream             text(printed);
    const std::vector<std::string> expected = Lines(file);
    const std::vector<std::string> computed = Lines(text);
    std::size_t                    differ = 0;
    for (std::size_t i = 0; i < std::max(expected.size(), computed.size()); ++i)
    {
      const std::string want = i < expected.size() ? expected[i] : "nothing";
      const std::string have = i < computed.size() ? computed[i] : "nothing";
      if (want != have)
      {
        ++differ;
        std::cout << have << "\n  where " << want << " is expected\n";
      }
    }
    std::cout << computed.size() << " runs, " << differ << " of them with other bytes than in " << argv[1] << '\n';
    return differ == 0 && !expected.empty() ? 0 : 1;
  }
  catch (const std::exception & error)
  {
    std::cerr << "GoldenBytes: " << error.what() << '\n';
    return 1;
  }
}
