// SPDX-License-Identifier: Apache-2.0
// CompareVolumes REFERENCE TEST: how far a volume is from a reference, as text or as JSON.

#include "Figures.h"
#include "GridComparison.h"
#include "commandline/CommandLine.h"
#include "commandline/Warnings.h"
#include "formats/OpenVolume.h"
#include "itk/FileIntegrity.h"
#include "system/process/LibraryMessages.h"
#include "system/process/Terminal.h"
#include "system/process/WatchedRun.h"
#include "system/process/WatchedTask.h"
#include "text/OneLineMessage.h"

#include "itkMacro.h"

#include <cmath>
#include <cstdio>
#include <new>

namespace
{
struct Options
{
  std::string  ReferencePath;
  std::string  TestPath;
  InputOptions Reference;
  InputOptions Test;
  Comparison   How;
  bool         Json = false;
  bool         Quiet = false;
  bool         IgnoreGeometry = false;
};

/** Voxels that the same place in both images may be apart. */
constexpr double LargestShift = 1e-3;

std::unique_ptr<VolumeReader>
Open(const std::string & path, const InputOptions & input, Warnings & warnings)
{
  const WatchedOpening opening(path);
  return OpenVolume(path, input, [&warnings](const std::string & text) { warnings.Add(text); });
}

void
CheckComponents(const Options & options, const VolumeReader & reference, const VolumeReader & test)
{
  const unsigned int components = reference.GetDescription().NumberOfComponents;
  if (test.GetDescription().NumberOfComponents != components)
  {
    throw std::runtime_error("cannot compare " + options.TestPath + ": its voxels have " +
                             std::to_string(test.GetDescription().NumberOfComponents) + " components, those of " +
                             options.ReferencePath + " have " + std::to_string(components));
  }
  if (components > 1 && test.GetDescription().Grid.Size != reference.GetDescription().Grid.Size)
  {
    throw std::runtime_error("the images differ in their region: " + options.TestPath + " has other sizes than " +
                             options.ReferencePath);
  }
}

void
CheckGrids(const ImageGrid & reference, const ImageGrid & test, const bool ignoreGeometry)
{
  if (test.Size.size() != reference.Size.size())
  {
    throw std::runtime_error("the images differ in dimension: the reference has " +
                             std::to_string(reference.Size.size()) + ", the test image " +
                             std::to_string(test.Size.size()));
  }
  if (test.Size == reference.Size && !ignoreGeometry && !(GetLargestShift(reference, test) <= LargestShift))
  {
    throw std::runtime_error("the images lie in different places (--ignore-geometry compares them nevertheless): " +
                             DescribeDifference(reference, test));
  }
}

void
Run(const Options & options)
{
  const LibraryMessages messages;
  Warnings              warnings(options.Quiet);
  const WarningSink     warn = [&warnings](const std::string & text) { warnings.Add(text); };
  const auto            reference = Open(options.ReferencePath, options.Reference, warnings);
  const auto            test = Open(options.TestPath, options.Test, warnings);
  CheckComponents(options, *reference, *test);
  CheckGrids(reference->GetDescription().Grid, test->GetDescription().Grid, options.IgnoreGeometry);
  const Figures figures = Compare(*reference, *test, options.How);
  CheckMessages(options.TestPath, messages.GetText());
  WarnOfRounding(options.ReferencePath,
                 reference->GetDescription().Component,
                 figures.ReferenceMinimum,
                 figures.ReferenceMaximum,
                 warn);
  WarnOfRounding(options.TestPath, test->GetDescription().Component, figures.TestMinimum, figures.TestMaximum, warn);
  PrintResult(options.Json ? ToJson(figures, warnings.GetAll()) : ToText(figures));
}

std::string
CheckLevel(const std::string & text)
{
  return IsNumber(text) && std::stod(text) >= 0.0 && std::stod(text) <= 1.0
           ? std::string()
           : "it must be a number from 0 to 1, not " + text;
}

std::string
CheckPeak(const std::string & text)
{
  return IsNumber(text) && std::isfinite(std::stod(text)) && std::stod(text) > 0.0
           ? std::string()
           : "it must be a finite number greater than 0, not " + text;
}

void
Describe(CLI::App & app, Options & options)
{
  app.add_option("REFERENCE",
                 options.ReferencePath,
                 "The image that is compared with: a file, or a folder with a DICOM series or with slices");
  app.add_option("TEST", options.TestPath, "The image that is judged: same size, same geometry");
  app.add_flag("--json", options.Json, "Print a JSON object; all errors in it are fractions");
  app.add_option("--peak", options.How.Peak, "The peak (default: the range of the reference)")
    ->check(CLI::Validator(CheckPeak, ""));
  app
    .add_option_function<std::vector<double>>(
      "--quantile",
      [&options](const std::vector<double> & levels) {
        options.How.QuantileLevels.insert(options.How.QuantileLevels.end(), levels.begin(), levels.end());
      },
      "More quantiles of the relative error, by levels from 0 to 1")
    ->check(CLI::Validator(CheckLevel, ""));
  app.add_flag("--use-spacing", options.How.UseSpacing, "Take the total variation in physical space");
  app.add_flag("--ignore-geometry",
               options.IgnoreGeometry,
               "Compare images that lie more than a thousandth of a voxel apart, too");
  AddInputOptions(app, options.Reference);
  AddRawOption(app, "--raw", options.Reference.Raw, "REFERENCE");
  AddRawOption(app, "--test-raw", options.Test.Raw, "TEST");
  app.add_flag("--quiet", options.Quiet, "Print no warnings");
  app.set_version_flag("--version", std::string("CompareVolumes ") + COMPARE_VOLUMES_VERSION);
  app.footer("How the inputs are read (--series, --spacing, --origin, --channel, --frame) goes for both images.\n"
             "Voxels at which either image is not finite are left out and counted. The components of voxels with "
             "several\nare compared one by one, and each counts as a voxel.\n"
             "In JSON, null stands for a figure that is infinite or undefined, such as the PSNR of equal images.\n\n"
             "Examples:\n"
             "  CompareVolumes truth.mha doubled.nii.gz\n"
             "  CompareVolumes --json --quantile 0.9 0.999 -- truth.mha doubled.mha\n\n"
             "Exit status: 0 if the images were compared, 1 if they could not be, 2 if the command line was wrong.");
}

int
Fail(ExitCode code, const std::string & message)
{
  std::fprintf(GetTerminal(), "CompareVolumes: %s\n", MakeOneLine(message).c_str());
  return code;
}
int
RunProgram(int argc, char * argv[])
{
  try
  {
    Options  options;
    CLI::App app{
      "Compares a volume with a reference: PSNR, relative L2 error, quantiles of |test - reference| / peak, "
      "total variation, and ranges.",
      "CompareVolumes"
    };
    Describe(app, options);
    if (const auto exitCode = ParseArguments(app, argc, argv))
    {
      return *exitCode;
    }
    Require(options.ReferencePath, "REFERENCE");
    Require(options.TestPath, "TEST");
    const auto raw = options.Test.Raw;
    options.Test = options.Reference;
    options.Test.Raw = raw;
    Run(options);
    return Success;
  }
  catch (const UsageError & error)
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
} // namespace

int
main(int argc, char * argv[])
{
  return RunWatched([&] { return RunProgram(argc, argv); });
}
