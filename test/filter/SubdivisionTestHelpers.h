// SPDX-License-Identifier: Apache-2.0
#ifndef SubdivisionTestHelpers_h
#define SubdivisionTestHelpers_h

#include "common/SubdivisionReference.h"

#include "itkConstantBoundaryCondition.h"
#include "itkImage.h"
#include "itkImageRegionConstIterator.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkMirrorBoundaryCondition.h"
#include "itkNonOscillatorySubdivisionImageFilter.h"
#include "itkPeriodicBoundaryCondition.h"
#include "itkVectorImage.h"
#include "itkZeroFluxNeumannBoundaryCondition.h"

#include "itkGTest.h"

#include <cstring>
#include <random>

/** What the tests of the filter share: images to subdivide, boundary conditions by name, and comparisons. */
namespace SubdivisionTest
{
namespace ref = SubdivisionReference;

using SchemeEnum = itk::NonOscillatorySubdivisionImageFilterEnums::Scheme;

inline std::vector<SchemeEnum>
AllSchemes()
{
  return {
    SchemeEnum::NonOscillatory, SchemeEnum::Linear, SchemeEnum::BoundedLinear, SchemeEnum::BSpline, SchemeEnum::Restored
  };
}

inline ref::Scheme
ToReference(SchemeEnum scheme)
{
  switch (scheme)
  {
    case SchemeEnum::NonOscillatory:
      return ref::Scheme::NonOscillatory;
    case SchemeEnum::Linear:
      return ref::Scheme::Linear;
    case SchemeEnum::BoundedLinear:
      return ref::Scheme::BoundedLinear;
    case SchemeEnum::Restored:
      return ref::Scheme::Restored;
    default:
      return ref::Scheme::BSpline;
  }
}

enum class BoundaryKind
{
  ZeroFlux,
  Mirror,
  Periodic,
  Constant
};

inline std::vector<BoundaryKind>
AllBoundaries()
{
  return { BoundaryKind::ZeroFlux, BoundaryKind::Mirror, BoundaryKind::Periodic, BoundaryKind::Constant };
}

inline const char *
NameOf(BoundaryKind kind)
{
  constexpr std::array<const char *, 4> names{ "zero flux", "mirror", "periodic", "constant" };
  return names[static_cast<int>(kind)];
}

template <unsigned int D>
ref::Boundary<D>
ReferenceBoundary(BoundaryKind kind, double constant)
{
  switch (kind)
  {
    case BoundaryKind::Mirror:
      return ref::Mirror<D>();
    case BoundaryKind::Periodic:
      return ref::Periodic<D>();
    case BoundaryKind::Constant:
      return ref::Constant<D>(constant);
    default:
      return ref::ZeroFlux<D>();
  }
}

/** One boundary condition of each kind; the filter borrows the one it is given. */
template <typename TImage>
struct BoundaryConditions
{
  itk::ZeroFluxNeumannBoundaryCondition<TImage> zeroFlux;
  itk::MirrorBoundaryCondition<TImage>          mirror;
  itk::PeriodicBoundaryCondition<TImage>        periodic;
  itk::ConstantBoundaryCondition<TImage>        constant;

  itk::ImageBoundaryCondition<TImage> *
  Get(BoundaryKind kind)
  {
    switch (kind)
    {
      case BoundaryKind::Mirror:
        return &mirror;
      case BoundaryKind::Periodic:
        return &periodic;
      case BoundaryKind::Constant:
        return &constant;
      default:
        return &zeroFlux;
    }
  }
};

template <typename TImage>
typename TImage::RegionType
MakeRegion(const ref::Index<TImage::ImageDimension> & start, const ref::Index<TImage::ImageDimension> & size)
{
  typename TImage::RegionType region;
  for (unsigned int w = 0; w < TImage::ImageDimension; ++w)
  {
    region.SetIndex(w, start[w]);
    region.SetSize(w, size[w]);
  }
  return region;
}

/** An allocated image; its values are left to the caller. */
template <typename TImage>
typename TImage::Pointer
MakeImage(const typename TImage::RegionType & region, unsigned int components = 1)
{
  auto image = TImage::New();
  image->SetRegions(region);
  image->SetNumberOfComponentsPerPixel(components);
  image->Allocate();
  return image;
}

/** The scalars of an image's buffer, the components of a pixel next to each other. */
template <typename TImage>
auto
ScalarsOf(TImage * image)
{
  using Scalar = typename itk::NumericTraits<typename TImage::PixelType>::ValueType;
  return reinterpret_cast<Scalar *>(image->GetBufferPointer());
}

template <typename TImage>
auto
ScalarsOf(const TImage * image)
{
  using Scalar = typename itk::NumericTraits<typename TImage::PixelType>::ValueType;
  return reinterpret_cast<const Scalar *>(image->GetBufferPointer());
}

template <typename TImage>
std::size_t
CountScalars(const TImage * image)
{
  return image->GetBufferedRegion().GetNumberOfPixels() * image->GetNumberOfComponentsPerPixel();
}

/** Test data of several natures, as thresholds behave differently on each: noise, a smooth wave, flat blocks with
 * jumps between them, and single spikes on a flat ground. */
class TestSignal
{
public:
  explicit TestSignal(unsigned int seed)
    : m_Engine(seed)
    , m_Nature(seed % 4)
  {}

  /** The next value, in [-1, 1], at the given position of the buffer. */
  double
  operator()(std::size_t position)
  {
    const double noise = m_Uniform(m_Engine);
    switch (m_Nature)
    {
      case 0:
        return noise;
      case 1:
        return std::sin(0.37 * static_cast<double>(position));
      case 2:
        m_Level = std::abs(noise) < 0.3 ? noise * 3.0 : m_Level;
        return m_Level;
      default:
        return std::abs(noise) < 0.05 ? noise * 20.0 : 0.0;
    }
  }

private:
  std::mt19937                           m_Engine;
  std::uniform_real_distribution<double> m_Uniform{ -1.0, 1.0 };
  double                                 m_Level = 0.5;
  unsigned int                           m_Nature;
};

/** Fills an image with test data spread over [low, high]. */
template <typename TImage>
void
FillWithTestData(TImage * image, double low, double high, unsigned int seed)
{
  using Scalar = typename itk::NumericTraits<typename TImage::PixelType>::ValueType;
  TestSignal signal(seed);
  for (std::size_t i = 0; i < CountScalars(image); ++i)
  {
    const double value = low + (high - low) * (signal(i) + 1.0) / 2.0;
    ScalarsOf(image)[i] = static_cast<Scalar>(std::is_integral<Scalar>::value ? std::round(value) : value);
  }
}

/** One component of an image as the reference takes it, its first index at 0. */
template <typename TImage>
ref::Grid<TImage::ImageDimension>
ToGrid(const TImage * image, unsigned int component = 0)
{
  constexpr unsigned int D = TImage::ImageDimension;
  ref::Index<D>          size;
  for (unsigned int w = 0; w < D; ++w)
  {
    size[w] = static_cast<long>(image->GetBufferedRegion().GetSize(w));
  }
  ref::Grid<D>       grid({}, size);
  const unsigned int components = image->GetNumberOfComponentsPerPixel();
  for (std::size_t i = 0; i < grid.values.size(); ++i)
  {
    grid.values[i] = static_cast<double>(ScalarsOf(image)[i * components + component]);
  }
  return grid;
}

/** An image of the values of a function of the index, given as itk::Index. */
template <typename TImage, typename TFunction>
typename TImage::Pointer
ImageOf(const typename TImage::RegionType & region, const TFunction & function)
{
  const auto                                image = MakeImage<TImage>(region);
  itk::ImageRegionIteratorWithIndex<TImage> it(image, region);
  for (; !it.IsAtEnd(); ++it)
  {
    it.Set(static_cast<typename TImage::PixelType>(function(it.GetIndex())));
  }
  return image;
}

/** A 1-D image of the given values. */
template <typename TImage>
typename TImage::Pointer
LineOf(const std::vector<double> & values)
{
  const auto region = MakeRegion<TImage>({ 0 }, { static_cast<long>(values.size()) });
  return ImageOf<TImage>(region, [&](const itk::Index<1> & i) { return values[i[0]]; });
}

/** The output of a filter that is run on an image, cut off from the pipeline. */
template <typename TFilter>
typename TFilter::OutputImageType::Pointer
RunFilter(TFilter * filter, const typename TFilter::InputImageType * input)
{
  filter->SetInput(input);
  filter->UpdateLargestPossibleRegion();
  typename TFilter::OutputImageType::Pointer output = filter->GetOutput();
  output->DisconnectPipeline();
  return output;
}

/** The axes of a filter as the reference takes them, and the other way round. */
template <typename TFilter>
void
SetAxes(TFilter * filter, const ref::Axes<TFilter::InputImageType::ImageDimension> & axes)
{
  itk::FixedArray<bool, TFilter::InputImageType::ImageDimension> chosen;
  for (unsigned int w = 0; w < axes.size(); ++w)
  {
    chosen[w] = axes[w];
  }
  filter->SetSubdividedAxes(chosen);
}

/** Whether two images have the same buffered region and the same bytes in it. */
template <typename TImage>
testing::AssertionResult
SameBytes(const TImage * a, const TImage * b)
{
  if (a->GetBufferedRegion() != b->GetBufferedRegion())
  {
    return testing::AssertionFailure() << "regions differ: " << a->GetBufferedRegion() << b->GetBufferedRegion();
  }
  using Scalar = std::remove_reference_t<decltype(*ScalarsOf(a))>;
  for (std::size_t i = 0; i < CountScalars(a); ++i)
  {
    if (std::memcmp(ScalarsOf(a) + i, ScalarsOf(b) + i, sizeof(Scalar)) != 0)
    {
      return testing::AssertionFailure() << "scalar " << i << " is " << +ScalarsOf(a)[i] << " and " << +ScalarsOf(b)[i];
    }
  }
  return testing::AssertionSuccess();
}

/** Whether a part of an image that was computed alone has the bytes of the whole. */
template <typename TImage>
testing::AssertionResult
SameBytesAsPartOf(const TImage * part, const TImage * whole)
{
  itk::ImageRegionConstIterator<TImage> it(part, part->GetBufferedRegion());
  itk::ImageRegionConstIterator<TImage> wholeIt(whole, part->GetBufferedRegion());
  for (; !it.IsAtEnd(); ++it, ++wholeIt)
  {
    const auto a = it.Get();
    const auto b = wholeIt.Get();
    if (std::memcmp(&a, &b, sizeof(a)) != 0)
    {
      return testing::AssertionFailure() << it.GetIndex() << " is " << +a << " and in the whole " << +b;
    }
  }
  return testing::AssertionSuccess();
}

/** A part of a region, from one pixel to the whole. */
template <typename TRegion>
TRegion
RandomSubRegion(const TRegion & whole, std::mt19937 & engine)
{
  const auto draw = [&](long first, long last) { return std::uniform_int_distribution<long>(first, last)(engine); };
  TRegion    region;
  for (unsigned int w = 0; w < TRegion::ImageDimension; ++w)
  {
    const long size = static_cast<long>(whole.GetSize(w));
    const long part = draw(1, size);
    region.SetSize(w, part);
    region.SetIndex(w, whole.GetIndex(w) + draw(0, size - part));
  }
  return region;
}

template <typename TImage>
double
LargestDifference(const TImage * a, const TImage * b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < CountScalars(a); ++i)
  {
    largest = std::max(largest, std::abs(static_cast<double>(ScalarsOf(a)[i]) - static_cast<double>(ScalarsOf(b)[i])));
  }
  return largest;
}

} // namespace SubdivisionTest

#endif
