// SPDX-License-Identifier: Apache-2.0
// Writes the inputs and the baselines of the test driver: `MakeBaselines TEST_DIRECTORY`. The baselines are made by the
// slow reference alone; their geometry is worked out here as well, without the filter.

#include "common/SubdivisionReference.h"

#include "itkImageFileWriter.h"
#include "itkMetaImageIOFactory.h"
#include "itkNrrdImageIOFactory.h"

#include <iostream>
#include <stdexcept>
#include <string>

namespace ref = SubdivisionReference;

namespace
{

using Slice = itk::Image<unsigned char, 2>;
using Volume = itk::Image<short, 3>;
using RealVolume = itk::Image<float, 3>;

template <typename TImage>
typename TImage::Pointer
MakeImage(const ref::Grid<TImage::ImageDimension> & grid)
{
  typename TImage::SizeType size;
  std::copy(grid.size.begin(), grid.size.end(), size.begin());
  auto image = TImage::New();
  image->SetRegions(size);
  image->Allocate();
  std::transform(grid.values.begin(), grid.values.end(), image->GetBufferPointer(), [](double value) {
    return static_cast<typename TImage::PixelType>(value);
  });
  return image;
}

template <typename TImage>
void
Write(const TImage * image, const std::string & path)
{
  auto writer = itk::ImageFileWriter<TImage>::New();
  writer->SetInput(image);
  writer->SetFileName(path);
  writer->UseCompressionOn();
  writer->Update();
  std::cout << path << '\n';
}

/** A bright ellipse with a sharp edge on a ramp, with a dark hole, in 22 x 17 voxels. */
ref::Grid<2>
SliceValues()
{
  return ref::MakeGrid<2>({}, { 22, 17 }, [](const ref::Index<2> & i) {
    const double x = (i[0] - 10.2) / 8.0;
    const double y = (i[1] - 8.4) / 5.5;
    if (x * x + y * y > 1.0)
    {
      return 2.0 + 3.0 * i[0];
    }
    return i[0] >= 7 && i[0] < 10 && i[1] >= 7 && i[1] < 9 ? 0.0 : 251.0 - 4.0 * i[1];
  });
}

/** A ball of 1200 in air of -1000 with a smooth wave upon it, in 9 x 8 x 7 voxels. */
ref::Grid<3>
VolumeValues()
{
  return ref::MakeGrid<3>({}, { 9, 8, 7 }, [](const ref::Index<3> & i) {
    const double distance = std::hypot(i[0] - 3.7, i[1] - 4.1, i[2] - 2.8);
    return std::round((distance < 3.0 ? 1200.0 : -1000.0) + 60.0 * std::sin(0.8 * i[0] + 0.5 * i[1] - 0.6 * i[2]));
  });
}

template <typename TImage>
void
PlaceInput(TImage * image)
{
  constexpr unsigned int         D = TImage::ImageDimension;
  typename TImage::SpacingType   spacing;
  typename TImage::PointType     origin;
  typename TImage::DirectionType direction;
  direction.SetIdentity();
  for (unsigned int w = 0; w < D; ++w)
  {
    spacing[w] = 0.5 + 0.25 * w;
    origin[w] = 10.0 - 20.0 * w;
  }
  // The first two axes turned by a right angle.
  direction(0, 0) = 0.0;
  direction(0, 1) = -1.0;
  direction(1, 0) = 1.0;
  direction(1, 1) = 0.0;
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(direction);
}

/** Output index 0 lies at -1/4 of the input index along every subdivided axis, with half the spacing. */
template <typename TImage, unsigned int D>
void
PlaceOutput(TImage * image, const ref::Axes<D> & axes)
{
  PlaceInput(image);
  auto                         spacing = image->GetSpacing();
  typename TImage::SpacingType step;
  for (unsigned int w = 0; w < D; ++w)
  {
    step[w] = axes[w] ? -0.25 * spacing[w] : 0.0;
    spacing[w] *= axes[w] ? 0.5 : 1.0;
  }
  image->SetOrigin(image->GetOrigin() + image->GetDirection() * step);
  image->SetSpacing(spacing);
}

/** Integers are compared exactly, so no value may lie where a unit in the last place decides how it is rounded. */
void
RoundAwayFromTies(ref::Grid<2> & grid)
{
  for (double & value : grid.values)
  {
    const double fraction = value - std::floor(value);
    if (std::abs(fraction - 0.5) < 2e-4)
    {
      throw std::runtime_error("A value of the baseline is a tie: " + std::to_string(value));
    }
    value = std::min(std::max(std::round(value), 0.0), 255.0);
  }
}

void
WriteSliceBaseline(const std::string & path, ref::Scheme scheme, const ref::Boundary<2> & boundary)
{
  ref::Settings<2> settings;
  settings.scheme = scheme;
  settings.boundary = boundary;
  auto children = ref::Subdivide<2>(SliceValues(), settings);
  RoundAwayFromTies(children);
  const auto image = MakeImage<Slice>(children);
  PlaceOutput<Slice, 2>(image, settings.axes);
  Write<Slice>(image, path);
}

void
WriteVolumeBaseline(const std::string &      path,
                    ref::Scheme              scheme,
                    const ref::Boundary<3> & boundary,
                    const ref::Axes<3> &     axes)
{
  ref::Settings<3> settings;
  settings.scheme = scheme;
  settings.boundary = boundary;
  settings.axes = axes;
  const auto image = MakeImage<RealVolume>(ref::Subdivide<3>(VolumeValues(), settings));
  PlaceOutput<RealVolume, 3>(image, axes);
  Write<RealVolume>(image, path);
}

void
WriteAll(const std::string & directory)
{
  const auto slice = MakeImage<Slice>(SliceValues());
  PlaceInput<Slice>(slice);
  Write<Slice>(slice, directory + "/Input/slice.mha");
  const auto volume = MakeImage<Volume>(VolumeValues());
  PlaceInput<Volume>(volume);
  Write<Volume>(volume, directory + "/Input/volume.nrrd");

  const std::string base = directory + "/Baseline/";
  WriteSliceBaseline(base + "slice-nonoscillatory.mha", ref::Scheme::NonOscillatory, ref::ZeroFlux<2>());
  WriteSliceBaseline(base + "slice-bspline.mha", ref::Scheme::BSpline, ref::Periodic<2>());
  const ref::Axes<3> all{ true, true, true };
  WriteVolumeBaseline(base + "volume-nonoscillatory.nrrd", ref::Scheme::NonOscillatory, ref::Mirror<3>(), all);
  WriteVolumeBaseline(base + "volume-linear.nrrd", ref::Scheme::Linear, ref::ZeroFlux<3>(), all);
  WriteVolumeBaseline(
    base + "volume-bounded.nrrd", ref::Scheme::BoundedLinear, ref::ZeroFlux<3>(), { true, true, false });
}

} // namespace

int
main(int argc, char * argv[])
{
  if (argc != 2)
  {
    std::cerr << "Usage: " << argv[0] << " TEST_DIRECTORY\n";
    return EXIT_FAILURE;
  }
  try
  {
    itk::MetaImageIOFactory::RegisterOneFactory();
    itk::NrrdImageIOFactory::RegisterOneFactory();
    WriteAll(argv[1]);
  }
  catch (const std::exception & error)
  {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
