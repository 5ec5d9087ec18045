// SPDX-License-Identifier: Apache-2.0
#include "Figures.h"

#include "volumes/RealVoxels.h"

#include "itkImageFidelityCalculator.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <sstream>

namespace
{
/** An image of the size and the spacing of a grid; one of fewer axes is one voxel wide along the others. */
template <typename TImage>
typename TImage::Pointer
MakeImage(const ImageGrid & grid)
{
  static_assert(TImage::ImageDimension >= 2, "an image of one axis is a row");
  const auto                   image = TImage::New();
  typename TImage::SizeType    size;
  typename TImage::SpacingType spacing(1.0);
  size.Fill(1);
  for (unsigned int axis = 0; axis < grid.Size.size(); ++axis)
  {
    size[axis] = grid.Size[axis];
    spacing[axis] = grid.Spacing[axis];
  }
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->Allocate();
  return image;
}

/** All components of all voxels, on a grid of so many. */
template <typename TImage>
typename TImage::Pointer
ReadImage(VolumeReader & reader, const ImageGrid & grid)
{
  const auto            image = MakeImage<TImage>(grid);
  itk::Subdivision::Box box;
  for (const std::uint64_t size : reader.GetDescription().Grid.Size)
  {
    box.push_back({ 0, size });
  }
  ReadReals(reader, box, image->GetBufferPointer());
  return image;
}

/** Whether all that is finite in both images is one number, the same in both. */
template <typename TImage>
bool
AreOneNumber(const TImage & reference, const TImage & test)
{
  using Real = typename TImage::PixelType;
  const Real * const  a = reference.GetBufferPointer();
  const Real * const  b = test.GetBufferPointer();
  std::optional<Real> number;
  for (itk::SizeValueType i = 0; i < reference.GetPixelContainer()->Size(); ++i)
  {
    if (std::isfinite(a[i]) && std::isfinite(b[i]))
    {
      number = number.value_or(a[i]);
      if (a[i] != *number || b[i] != *number)
      {
        return false;
      }
    }
  }
  return number.has_value();
}

template <typename TImage>
Figures
CompareImages(const typename TImage::Pointer & reference,
              const typename TImage::Pointer & test,
              const Comparison &               comparison)
{
  const auto calculator = itk::ImageFidelityCalculator<TImage>::New();
  calculator->SetReferenceImage(reference);
  calculator->SetTestImage(test);
  // Without errors, any peak gives the same figures.
  const bool isOneSize = reference->GetBufferedRegion() == test->GetBufferedRegion();
  const bool needsNoPeak = comparison.Peak == 0.0 && isOneSize && AreOneNumber(*reference, *test);
  calculator->SetPeak(needsNoPeak ? 1.0 : comparison.Peak);
  calculator->SetQuantileLevels(comparison.QuantileLevels);
  calculator->SetUseImageSpacing(comparison.UseSpacing);
  calculator->Update();
  return { calculator->GetPeakSignalToNoiseRatio(),
           needsNoPeak ? 0.0 : calculator->GetRelativeL2Error(),
           calculator->GetQuantileLevels(),
           calculator->GetRelativeErrorQuantiles(),
           calculator->GetRelativeTotalVariation(),
           calculator->GetReferenceTotalVariation(),
           calculator->GetTestTotalVariation(),
           calculator->GetReferenceMinimum(),
           calculator->GetReferenceMaximum(),
           calculator->GetTestMinimum(),
           calculator->GetTestMaximum(),
           needsNoPeak ? 0.0 : calculator->GetEffectivePeak(),
           calculator->GetNumberOfComparedVoxels(),
           calculator->GetNumberOfExcludedVoxels() };
}

/** One of the components that stand side by side in an image of numbers. */
template <typename TImage, typename TNumbers>
typename TImage::Pointer
TakeComponent(const TNumbers & numbers, const ImageGrid & grid, unsigned int component, unsigned int components)
{
  const auto         image = MakeImage<TImage>(grid);
  const auto * const from = numbers.GetBufferPointer() + component;
  auto * const       to = image->GetBufferPointer();
  for (itk::SizeValueType i = 0; i < image->GetPixelContainer()->Size(); ++i)
  {
    to[i] = from[i * components];
  }
  return image;
}

/** Takes all numbers of all components together; total variation, which neighbours make, is the components' sum. */
template <typename TImage>
Figures
CompareComponents(VolumeReader & reference, VolumeReader & test, const Comparison & comparison)
{
  using Numbers = itk::Image<typename TImage::PixelType, 2>;
  const ImageDescription & description = reference.GetDescription();
  const ImageGrid &        grid = description.Grid;
  const unsigned int       components = description.NumberOfComponents;
  ImageGrid                flat;
  flat.Size = { grid.Size[0] * components, description.GetNumberOfVoxels() / grid.Size[0] };
  flat.Spacing = { 1.0, 1.0 };
  const auto a = ReadImage<Numbers>(reference, flat);
  const auto b = ReadImage<Numbers>(test, flat);
  Figures    figures = CompareImages<Numbers>(a, b, comparison);
  figures.ReferenceTotalVariation = 0.0;
  figures.TestTotalVariation = 0.0;
  for (unsigned int component = 0; component < components; ++component)
  {
    const Comparison anyPeak = { 1.0, {}, comparison.UseSpacing };
    const Figures    own = CompareImages<TImage>(TakeComponent<TImage>(*a, grid, component, components),
                                              TakeComponent<TImage>(*b, grid, component, components),
                                              anyPeak);
    figures.ReferenceTotalVariation += own.ReferenceTotalVariation;
    figures.TestTotalVariation += own.TestTotalVariation;
  }
  figures.RelativeTotalVariation = itk::ImageFidelityCalculator<TImage>::GetRelativeTotalVariation(
    figures.ReferenceTotalVariation, figures.TestTotalVariation);
  return figures;
}

template <typename TReal, unsigned int VDimension>
Figures
CompareAs(VolumeReader & reference, VolumeReader & test, const Comparison & comparison)
{
  using ImageType = itk::Image<TReal, VDimension>;
  const ImageGrid & grid = reference.GetDescription().Grid;
  ImageGrid         testGrid = grid;
  testGrid.Size = test.GetDescription().Grid.Size;
  return reference.GetDescription().NumberOfComponents > 1
           ? CompareComponents<ImageType>(reference, test, comparison)
           : CompareImages<ImageType>(
               ReadImage<ImageType>(reference, grid), ReadImage<ImageType>(test, testGrid), comparison);
}

template <typename TReal>
Figures
CompareIn(VolumeReader & reference, VolumeReader & test, const Comparison & comparison)
{
  switch (reference.GetDescription().Grid.Size.size())
  {
    case 1:
    case 2:
      return CompareAs<TReal, 2>(reference, test, comparison);
    case 3:
      return CompareAs<TReal, 3>(reference, test, comparison);
    default:
      return CompareAs<TReal, 4>(reference, test, comparison);
  }
}
} // namespace

Figures
Compare(VolumeReader & reference, VolumeReader & test, const Comparison & comparison)
{
  // Float holds every value of the types that need no more.
  const bool needsDouble =
    NeedsDouble(reference.GetDescription().Component) || NeedsDouble(test.GetDescription().Component);
  return needsDouble ? CompareIn<double>(reference, test, comparison) : CompareIn<float>(reference, test, comparison);
}

std::string
ToJson(const Figures & figures, const std::vector<std::string> & warnings)
{
  nlohmann::ordered_json object;
  object["psnr_db"] = figures.PeakSignalToNoiseRatio;
  object["relative_l2_error"] = figures.RelativeL2Error;
  object["median_relative_error"] = figures.Quantiles[0];
  object["q99_relative_error"] = figures.Quantiles[1];
  object["relative_error_quantiles"] = nlohmann::ordered_json::array();
  for (std::size_t i = 2; i < figures.Quantiles.size(); ++i)
  {
    object["relative_error_quantiles"].push_back(
      { { "level", figures.QuantileLevels[i] }, { "value", figures.Quantiles[i] } });
  }
  object["relative_total_variation"] = figures.RelativeTotalVariation;
  object["reference_total_variation"] = figures.ReferenceTotalVariation;
  object["test_total_variation"] = figures.TestTotalVariation;
  object["reference_minimum"] = figures.ReferenceMinimum;
  object["reference_maximum"] = figures.ReferenceMaximum;
  object["test_minimum"] = figures.TestMinimum;
  object["test_maximum"] = figures.TestMaximum;
  object["peak"] = figures.Peak;
  object["compared_voxels"] = figures.ComparedVoxels;
  object["excluded_voxels"] = figures.ExcludedVoxels;
  object["warnings"] = warnings;
  // Warnings have names of files, which need not be UTF-8, but JSON must.
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string
ToText(const Figures & figures)
{
  std::ostringstream text;
  text << "PSNR: " << figures.PeakSignalToNoiseRatio << " dB (peak " << figures.Peak << ")\n"
       << "relative L2 error: " << 100.0 * figures.RelativeL2Error << " %\n";
  for (std::size_t i = 0; i < figures.Quantiles.size(); ++i)
  {
    text << "relative error, quantile " << figures.QuantileLevels[i] << ": " << 100.0 * figures.Quantiles[i] << " %\n";
  }
  text << "relative total variation: " << 100.0 * figures.RelativeTotalVariation << " % (" << figures.TestTotalVariation
       << " of " << figures.ReferenceTotalVariation << ")\n"
       << "reference range: " << figures.ReferenceMinimum << " to " << figures.ReferenceMaximum << '\n'
       << "test range: " << figures.TestMinimum << " to " << figures.TestMaximum << '\n'
       << "voxels: " << figures.ComparedVoxels << " compared, " << figures.ExcludedVoxels << " excluded (not finite)\n";
  return text.str();
}
