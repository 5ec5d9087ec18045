// SPDX-License-Identifier: Apache-2.0
#include "Figures.h"

#include "volumes/RealVoxels.h"

#include "itkImageFidelityCalculator.h"

#include <nlohmann/json.hpp>

#include <sstream>

namespace
{
/** The voxels of an image, on the grid of another one. */
template <typename TImage>
typename TImage::Pointer
ReadImage(VolumeReader & reader, const ImageGrid & grid)
{
  constexpr unsigned int             dimension = TImage::ImageDimension;
  const std::vector<std::uint64_t> & size = reader.GetDescription().Grid.Size;
  const auto                         image = TImage::New();
  typename TImage::SizeType          imageSize;
  typename TImage::SpacingType       spacing(1.0);
  itk::Subdivision::Box              box;
  imageSize.Fill(1);
  for (unsigned int axis = 0; axis < size.size(); ++axis)
  {
    imageSize[axis] = size[axis];
    spacing[axis] = grid.Spacing[axis];
    box.push_back({ 0, size[axis] });
  }
  static_assert(dimension >= 2, "an image of one axis is a row");
  image->SetRegions(imageSize);
  image->SetSpacing(spacing);
  image->Allocate();
  ReadReals(reader, box, image->GetBufferPointer());
  return image;
}

template <typename TReal, unsigned int VDimension>
Figures
CompareAs(VolumeReader & reference, VolumeReader & test, const Comparison & comparison)
{
  using ImageType = itk::Image<TReal, VDimension>;
  const ImageGrid & grid = reference.GetDescription().Grid;
  const auto        calculator = itk::ImageFidelityCalculator<ImageType>::New();
  calculator->SetReferenceImage(ReadImage<ImageType>(reference, grid));
  calculator->SetTestImage(ReadImage<ImageType>(test, grid));
  calculator->SetPeak(comparison.Peak);
  calculator->SetQuantileLevels(comparison.QuantileLevels);
  calculator->SetUseImageSpacing(comparison.UseSpacing);
  calculator->Update();
  return { calculator->GetPeakSignalToNoiseRatio(),
           calculator->GetRelativeL2Error(),
           calculator->GetQuantileLevels(),
           calculator->GetRelativeErrorQuantiles(),
           calculator->GetRelativeTotalVariation(),
           calculator->GetReferenceTotalVariation(),
           calculator->GetTestTotalVariation(),
           calculator->GetReferenceMinimum(),
           calculator->GetReferenceMaximum(),
           calculator->GetTestMinimum(),
           calculator->GetTestMaximum(),
           calculator->GetEffectivePeak(),
           calculator->GetNumberOfComparedVoxels(),
           calculator->GetNumberOfExcludedVoxels() };
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
