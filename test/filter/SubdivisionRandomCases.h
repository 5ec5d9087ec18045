// SPDX-License-Identifier: Apache-2.0
#ifndef SubdivisionRandomCases_h
#define SubdivisionRandomCases_h

#include "SubdivisionTestHelpers.h"

#include "itkDefaultConvertPixelTraits.h"

#include <sstream>

/** Comparisons of the filter with the slow reference on random images and settings. */
namespace SubdivisionTest
{

template <typename TImage>
using ScalarOf = typename itk::NumericTraits<typename TImage::PixelType>::ValueType;

/** Whether a type makes the filter compute with double: double itself, and 32- and 64-bit integers. */
template <typename TScalar>
constexpr bool NeedsDouble =
  std::is_same<TScalar, double>::value || (std::is_integral<TScalar>::value && sizeof(TScalar) >= 4);

/** The largest difference allowed between the filter and the reference, before rounding to integers: so many units
 * in the last place of the largest magnitude in the image. On noise, where thresholds of every subset of axes add up,
 * the sums of magnitudes in the scheme reach (2.6)^3 times that magnitude. */
template <typename TInputScalar, typename TOutputScalar>
double
AllowedDifference(double largestMagnitude)
{
  constexpr bool inDouble = NeedsDouble<TInputScalar> || NeedsDouble<TOutputScalar>;
  const double   epsilon = inDouble ? std::numeric_limits<double>::epsilon() : std::numeric_limits<float>::epsilon();
  return 16.0 * epsilon * largestMagnitude;
}

/** What an output pixel of the given type may differ from a real value. */
template <typename TOutputScalar>
testing::AssertionResult
IsConversionOf(TOutputScalar pixel, double value, double allowed)
{
  if (std::is_integral<TOutputScalar>::value)
  {
    const double lowest = static_cast<double>(std::numeric_limits<TOutputScalar>::lowest());
    const double highest = static_cast<double>(std::numeric_limits<TOutputScalar>::max());
    value = std::min(std::max(value, lowest), highest);
    allowed += 0.5; // rounding to nearest
  }
  const double difference = std::abs(static_cast<double>(pixel) - value);
  if (difference <= allowed)
  {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << +pixel << " stands where the reference has " << value << ", off by "
                                     << difference << " where " << allowed << " is allowed";
}

/** One random image size, start and setting. */
template <unsigned int D>
struct RandomCase
{
  ref::Index<D> size;
  ref::Index<D> start;
  ref::Axes<D>  axes;
  SchemeEnum    scheme;
  BoundaryKind  boundary;
  double        tension;
  double        constant;

  RandomCase(std::mt19937 & engine, double low, double high)
  {
    constexpr std::array<long, 4>   longest{ 80, 40, 30, 9 };
    constexpr std::array<double, 7> tensions{ 1.01, 1.5, 2.0, 4.0, 8.0, 1e3, std::numeric_limits<double>::max() };
    constexpr long                  mostVoxels = 900;
    const auto draw = [&](long first, long last) { return std::uniform_int_distribution<long>(first, last)(engine); };

    long voxels = 1;
    for (unsigned int w = 0; w < D; ++w)
    {
      size[w] = draw(1, std::max(1L, std::min(longest[D - 1], mostVoxels / voxels)));
      voxels *= size[w];
      start[w] = draw(-20, 20);
      axes[w] = draw(0, 3) > 0;
    }
    std::shuffle(size.begin(), size.end(), engine);
    if (D == 4 && axes == ref::Settings<D>::AllAxes())
    {
      axes[draw(0, D - 1)] = false;
    }
    scheme = AllSchemes()[draw(0, 4)];
    boundary = AllBoundaries()[draw(0, 3)];
    // The restored scheme's limit is the more sensitive to what is rounded, the larger the tension.
    tension = scheme == SchemeEnum::Restored ? tensions[draw(0, 2)] - 1.0 : tensions[draw(0, 6)];
    constant = std::round(low + (high - low) * draw(0, 4) / 4.0);
  }

  std::string
  Description() const
  {
    std::ostringstream text;
    text << scheme << ", tension " << tension << ", boundary " << NameOf(boundary) << " " << constant << ", size";
    for (unsigned int w = 0; w < D; ++w)
    {
      text << ' ' << size[w] << (axes[w] ? "" : " (kept)");
    }
    return text.str();
  }

  ref::Settings<D>
  ReferenceSettings() const
  {
    ref::Settings<D> settings;
    settings.scheme = ToReference(scheme);
    settings.tension = tension;
    settings.boundary = ReferenceBoundary<D>(boundary, constant);
    settings.axes = axes;
    return settings;
  }
};

/** A pixel of any type with all components alike. */
template <typename TImage>
typename TImage::PixelType
UniformPixel(unsigned int components, double value)
{
  using Pixel = typename TImage::PixelType;
  Pixel pixel{};
  itk::NumericTraits<Pixel>::SetLength(pixel, components);
  for (unsigned int c = 0; c < components; ++c)
  {
    itk::DefaultConvertPixelTraits<Pixel>::SetNthComponent(
      static_cast<int>(c), pixel, static_cast<ScalarOf<TImage>>(value));
  }
  return pixel;
}

/** Compares one component of an output, at every child if they are few, and otherwise at a random choice of them. */
template <typename TOutputImage, unsigned int D>
void
ExpectComponent(const TOutputImage *        output,
                unsigned int                component,
                const ref::Subdivision<D> & reference,
                double                      allowed,
                std::mt19937 &              engine)
{
  constexpr std::size_t most = 1500;
  const std::size_t     children = output->GetBufferedRegion().GetNumberOfPixels();
  const unsigned int    components = output->GetNumberOfComponentsPerPixel();
  for (std::size_t i = 0; i < std::min(children, most); ++i)
  {
    const std::size_t child =
      children <= most ? i : std::uniform_int_distribution<std::size_t>(0, children - 1)(engine);
    const auto    index = output->ComputeIndex(static_cast<itk::OffsetValueType>(child));
    ref::Index<D> m;
    for (unsigned int w = 0; w < D; ++w)
    {
      m[w] = index[w] - output->GetBufferedRegion().GetIndex(w);
    }
    ASSERT_TRUE(IsConversionOf(ScalarsOf(output)[child * components + component], reference.At(m), allowed))
      << "child " << index << ", component " << component;
  }
}

/** Runs the filter and the reference on random cases. Values of input pixels lie within [low, high]. */
template <typename TInputImage, typename TOutputImage = TInputImage>
void
CompareWithReference(unsigned int cases, double low, double high, unsigned int components = 1)
{
  constexpr unsigned int D = TInputImage::ImageDimension;
  using FilterType = itk::NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>;
  for (unsigned int seed = 0; seed < cases; ++seed)
  {
    std::mt19937        engine(seed);
    const RandomCase<D> drawn(engine, low, high);
    SCOPED_TRACE(drawn.Description());

    const auto input = MakeImage<TInputImage>(MakeRegion<TInputImage>(drawn.start, drawn.size), components);
    FillWithTestData(input.GetPointer(), low, high, seed);

    BoundaryConditions<TInputImage> boundaries;
    boundaries.constant.SetConstant(UniformPixel<TInputImage>(components, drawn.constant));
    auto filter = FilterType::New();
    filter->SetScheme(drawn.scheme);
    filter->SetTension(drawn.tension);
    filter->SetBoundaryCondition(boundaries.Get(drawn.boundary));
    SetAxes(filter.GetPointer(), drawn.axes);
    const auto output = RunFilter(filter.GetPointer(), input.GetPointer());

    ASSERT_EQ(output->GetNumberOfComponentsPerPixel(), components);
    const double allowed =
      AllowedDifference<ScalarOf<TInputImage>, ScalarOf<TOutputImage>>(std::max(std::abs(low), std::abs(high)));
    for (unsigned int c = 0; c < components; ++c)
    {
      const ref::Subdivision<D> reference(ToGrid(input.GetPointer(), c), drawn.ReferenceSettings());
      ASSERT_NO_FATAL_FAILURE(ExpectComponent<TOutputImage>(output, c, reference, allowed, engine));
    }
  }
}

} // namespace SubdivisionTest

#endif
