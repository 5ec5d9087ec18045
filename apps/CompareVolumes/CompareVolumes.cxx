// SPDX-License-Identifier: Apache-2.0
// CompareVolumes REFERENCE TEST: how far a volume is from a reference, as text or as JSON.

#include "FileIntegrity.h"
#include "InputImage.h"
#include "LibraryMessages.h"
#include "OneLineMessage.h"

#include "itkImageFidelityCalculator.h"
#include "itkImageFileReader.h"
#include "itkImageSeriesReader.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <iostream>
#include <limits>
#include <locale>
#include <new>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
enum ExitCode
{
  Success = 0,
  RunFailed = 1,
  WrongUsage = 2
};

struct Options
{
  std::string         referencePath;
  std::string         testPath;
  bool                json{ false };
  double              peak{ 0.0 }; // 0: the range of the reference
  std::vector<double> quantileLevels;
  bool                useSpacing{ false };
};

/** The median and the 99 % quantile are always computed, and come first. */
std::vector<double>
GetQuantileLevels(const Options & options)
{
  std::vector<double> levels{ 0.5, 0.99 };
  levels.insert(levels.end(), options.quantileLevels.begin(), options.quantileLevels.end());
  return levels;
}

/** Reads the header. */
InputImage
OpenScalarImage(const std::string & path)
{
  const LibraryMessages messages;
  const InputImage      input = OpenInput(path, "");
  if (input.NumberOfComponents != 1)
  {
    throw std::runtime_error("cannot compare " + path + ": its voxels have " +
                             std::to_string(input.NumberOfComponents) + " components");
  }
  return input;
}

template <typename TImage>
typename itk::ImageSource<TImage>::Pointer
MakeReader(const InputImage & input)
{
  if (input.FileNames.size() > 1)
  {
    const auto reader = itk::ImageSeriesReader<TImage>::New();
    reader->SetImageIO(input.ImageIO);
    reader->SetFileNames(input.FileNames);
    return reader.GetPointer();
  }
  const auto reader = itk::ImageFileReader<TImage>::New();
  reader->SetImageIO(input.ImageIO);
  reader->SetFileName(input.FileNames.front());
  return reader.GetPointer();
}

template <typename TImage>
typename TImage::Pointer
ReadImage(const InputImage & input)
{
  const LibraryMessages messages;
  const auto            reader = MakeReader<TImage>(input);
  reader->Update();
  CheckMessages(input.FileNames.front(), messages.GetText());
  return reader->GetOutput();
}

/** A number as JSON can hold it: null stands for infinity and NaN. */
std::string
ToJson(double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  text << value;
  return std::isfinite(value) ? text.str() : "null";
}

template <typename TCalculator>
void
PrintJson(const TCalculator & calculator)
{
  const std::vector<double> & levels = calculator.GetQuantileLevels();
  const std::vector<double> & quantiles = calculator.GetRelativeErrorQuantiles();
  std::cout << "{\n"
            << "  \"psnr_db\": " << ToJson(calculator.GetPeakSignalToNoiseRatio()) << ",\n"
            << "  \"relative_l2_error\": " << ToJson(calculator.GetRelativeL2Error()) << ",\n"
            << "  \"median_relative_error\": " << ToJson(quantiles[0]) << ",\n"
            << "  \"q99_relative_error\": " << ToJson(quantiles[1]) << ",\n"
            << "  \"relative_error_quantiles\": [";
  for (std::size_t i = 2; i < levels.size(); ++i)
  {
    std::cout << (i == 2 ? "" : ", ") << "{ \"level\": " << ToJson(levels[i]) << ", \"value\": " << ToJson(quantiles[i])
              << " }";
  }
  std::cout << "],\n"
            << "  \"relative_total_variation\": " << ToJson(calculator.GetRelativeTotalVariation()) << ",\n"
            << "  \"reference_total_variation\": " << ToJson(calculator.GetReferenceTotalVariation()) << ",\n"
            << "  \"test_total_variation\": " << ToJson(calculator.GetTestTotalVariation()) << ",\n"
            << "  \"reference_minimum\": " << ToJson(calculator.GetReferenceMinimum()) << ",\n"
            << "  \"reference_maximum\": " << ToJson(calculator.GetReferenceMaximum()) << ",\n"
            << "  \"test_minimum\": " << ToJson(calculator.GetTestMinimum()) << ",\n"
            << "  \"test_maximum\": " << ToJson(calculator.GetTestMaximum()) << ",\n"
            << "  \"peak\": " << ToJson(calculator.GetEffectivePeak()) << ",\n"
            << "  \"compared_voxels\": " << calculator.GetNumberOfComparedVoxels() << ",\n"
            << "  \"excluded_voxels\": " << calculator.GetNumberOfExcludedVoxels() << "\n"
            << "}\n";
}

template <typename TCalculator>
void
PrintText(const TCalculator & calculator)
{
  const std::vector<double> & levels = calculator.GetQuantileLevels();
  const std::vector<double> & quantiles = calculator.GetRelativeErrorQuantiles();
  std::cout << "PSNR: " << calculator.GetPeakSignalToNoiseRatio() << " dB (peak " << calculator.GetEffectivePeak()
            << ")\n"
            << "relative L2 error: " << 100.0 * calculator.GetRelativeL2Error() << " %\n";
  for (std::size_t i = 0; i < levels.size(); ++i)
  {
    std::cout << "relative error, quantile " << levels[i] << ": " << 100.0 * quantiles[i] << " %\n";
  }
  std::cout << "relative total variation: " << 100.0 * calculator.GetRelativeTotalVariation() << " % ("
            << calculator.GetTestTotalVariation() << " of " << calculator.GetReferenceTotalVariation() << ")\n"
            << "reference range: " << calculator.GetReferenceMinimum() << " to " << calculator.GetReferenceMaximum()
            << '\n'
            << "test range: " << calculator.GetTestMinimum() << " to " << calculator.GetTestMaximum() << '\n'
            << "voxels: " << calculator.GetNumberOfComparedVoxels() << " compared, "
            << calculator.GetNumberOfExcludedVoxels() << " excluded (not finite)\n";
}

template <typename TPixel, unsigned int VDimension>
void
Compare(const InputImage & reference, const InputImage & test, const Options & options)
{
  using ImageType = itk::Image<TPixel, VDimension>;
  const auto calculator = itk::ImageFidelityCalculator<ImageType>::New();
  calculator->SetReferenceImage(ReadImage<ImageType>(reference));
  calculator->SetTestImage(ReadImage<ImageType>(test));
  calculator->SetPeak(options.peak);
  calculator->SetQuantileLevels(GetQuantileLevels(options));
  calculator->SetUseImageSpacing(options.useSpacing);
  calculator->Update();
  if (options.json)
  {
    PrintJson(*calculator);
  }
  else
  {
    PrintText(*calculator);
  }
}

template <typename TPixel>
void
CompareInDimension(const InputImage & reference, const InputImage & test, const Options & options)
{
  switch (reference.Dimension)
  {
    case 1:
    case 2:
      return Compare<TPixel, 2>(reference, test, options);
    case 3:
      return Compare<TPixel, 3>(reference, test, options);
    default:
      return Compare<TPixel, 4>(reference, test, options);
  }
}

/** Whether float holds every value of this type. */
bool
FitsInFloat(PixelComponent component)
{
  return component == PixelComponent::FLOAT || GetPixelComponentSize(component) <= 2;
}

void
Run(const Options & options)
{
  const InputImage reference = OpenScalarImage(options.referencePath);
  const InputImage test = OpenScalarImage(options.testPath);
  if (test.Dimension != reference.Dimension)
  {
    throw std::runtime_error("the images differ in dimension: the reference has " +
                             std::to_string(reference.Dimension) + ", the test image " +
                             std::to_string(test.Dimension));
  }
  if (FitsInFloat(reference.Component) && FitsInFloat(test.Component))
  {
    CompareInDimension<float>(reference, test, options);
  }
  else
  {
    CompareInDimension<double>(reference, test, options);
  }
}

int
Fail(ExitCode code, const std::string & message)
{
  std::cerr << "CompareVolumes: " << MakeOneLine(message) << '\n';
  return code;
}

void
Describe(CLI::App & app, Options & options)
{
  app
    .add_option("REFERENCE", options.referencePath, "The image, or folder with a DICOM series, that is compared with.")
    ->required();
  app.add_option("TEST", options.testPath, "The image that is judged: same size, same geometry.")->required();
  app.add_flag("--json", options.json, "Print a JSON object; all errors in it are fractions.");
  app.add_option("--peak", options.peak, "The peak (default: the range of the reference).")->check(CLI::PositiveNumber);
  app.add_option("--quantile", options.quantileLevels, "More quantiles of the relative error, by levels from 0 to 1.")
    ->check(CLI::Range(0.0, 1.0));
  app.add_flag("--use-spacing", options.useSpacing, "Take the total variation in physical space.");
  app.footer("Voxels at which either image is not finite are left out and counted.\n"
             "In JSON, null stands for a figure that is infinite or undefined, such as the PSNR of equal images.");
}
} // namespace

int
main(int argc, char * argv[])
{
  Options  options;
  CLI::App app{ "Compares a volume with a reference: PSNR, relative L2 error, quantiles of |test - reference| / peak, "
                "total variation, and ranges.",
                "CompareVolumes" };
  Describe(app, options);
  try
  {
    app.parse(argc, argv);
    Run(options);
    return Success;
  }
  catch (const CLI::CallForHelp & help)
  {
    return app.exit(help);
  }
  catch (const CLI::ParseError & error)
  {
    return Fail(WrongUsage, std::string(error.what()) + " (see --help)");
  }
  catch (const std::bad_alloc &)
  {
    return Fail(RunFailed, "there is not enough memory");
  }
  catch (const itk::ExceptionObject & error)
  {
    return Fail(RunFailed, error.GetDescription());
  }
  catch (const std::exception & error)
  {
    return Fail(RunFailed, error.what());
  }
}
