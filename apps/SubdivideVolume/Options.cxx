// SPDX-License-Identifier: Apache-2.0
#include "Options.h"

#include "SlicerDescription.h"
#include "commandline/CommandLine.h"

#include "NonOscillatorySubdivision/LabelSubdivider.h"
#include "NonOscillatorySubdivision/Scheme.h"
#include "NonOscillatorySubdivision/Target.h"

namespace
{
using itk::Subdivision::ElementType;

constexpr const char * Footer = R"(Examples:
  SubdivideVolume scan.mha doubled.mha
  SubdivideVolume --scheme linear --axes xy dicom-folder/ doubled.nii.gz
  SubdivideVolume --spacing 0.02 slices/ doubled/          folders of TIFF slices
  SubdivideVolume --raw 1024x1024x800:uint16 scan.raw doubled.nrrd
  SubdivideVolume --memory 500M huge.mha huge-doubled.mha
  SubdivideVolume --levels 2 scan.mha fourfold.mha
  SubdivideVolume --labels organs.seg.nrrd doubled.seg.nrrd
  SubdivideVolume --piece 3/16 huge.mha huge-doubled.mha    one of 16 processes
  SubdivideVolume --info scan.mha

Exit status: 0 if the output is complete, 1 if the run failed, 2 if the command line was wrong.)";

std::string
CheckBoundary(std::string & text)
{
  const std::string word = CLI::detail::to_lower(text);
  if (word == "nearest" || word == "mirror" || word == "periodic")
  {
    text = word;
    return {};
  }
  return IsNumber(text) ? std::string() : "it must be nearest, mirror, periodic or a number, not " + text;
}

std::string
CheckAxes(std::string & text)
{
  text = CLI::detail::to_lower(text);
  const bool lettersOnly = text.find_first_not_of("xyzt") == std::string::npos;
  bool       once = true;
  for (const char axis : text)
  {
    once = once && text.find(axis) == text.rfind(axis);
  }
  return !text.empty() && text.size() <= 3 && lettersOnly && once
           ? std::string()
           : "it must be one to three different letters of x, y, z and t, not " + text;
}

/** The word becomes the number of bytes, which CLI11 then reads. */
std::string
BytesToNumber(std::string & text)
{
  try
  {
    text = std::to_string(ParseBytes(text));
    return {};
  }
  catch (const std::invalid_argument & error)
  {
    return error.what();
  }
}

/** Stands for what is best for the voxels; 3D Slicer cannot leave a choice out. */
constexpr const char * DefaultScheme = "default";

std::vector<std::string>
GetSchemeNames()
{
  std::vector<std::string> names = { DefaultScheme };
  for (const itk::Subdivision::Scheme & scheme : itk::Subdivision::Schemes)
  {
    names.emplace_back(scheme.Name);
  }
  return names;
}

std::vector<std::string>
GetTypeNames()
{
  std::vector<std::string> names = { "same" };
  for (auto type = ElementType::UInt8; type <= ElementType::Double;
       type = static_cast<ElementType>(static_cast<int>(type) + 1))
  {
    names.emplace_back(GetName(type));
  }
  return names;
}

void
AddComputation(CLI::App & app, Options & options)
{
  app
    .add_option("--scheme",
                options.Scheme,
                "The scheme: " + CLI::detail::join(GetSchemeNames(), ", ") +
                  "; default is nonoscillatory, with --labels restored")
    ->transform(OneOf(GetSchemeNames()));
  app.add_option("--tension",
                 options.Tension,
                 "How close the nonoscillatory and the restored scheme keep to the linear one: greater than 1; for "
                 "restored, 0 or greater (default: 2, with --labels 0)");
  app.add_flag("--labels",
               options.Labels,
               "The voxels are labels: none appears between two others (schemes restored, bspline and linear)");
  app.add_option("--levels", options.Levels, "How many times to double the resolution: 1, 2 or 3")
    ->capture_default_str()
    ->check(CLI::Range(1u, 3u));
  app.add_option("--boundary", options.Boundary, "Beyond the image: nearest, mirror, periodic or a value")
    ->capture_default_str()
    ->transform(CLI::Validator(CheckBoundary, ""));
  app.add_option("--axes", options.Axes, "The axes to subdivide, such as xyz or xy (default: the first three)")
    ->transform(CLI::Validator(CheckAxes, ""));
  app
    .add_option(
      "--output-type", options.OutputType, "The type of the output: " + CLI::detail::join(GetTypeNames(), ", "))
    ->capture_default_str()
    ->transform(OneOf(GetTypeNames()));
  app
    .add_option(
      "--target",
      options.Target,
      "The instruction set, such as AVX2 or portable (default: the fastest). Results of two may differ in the "
      "last place")
    ->transform(OneOf(itk::Subdivision::Target::GetNames()));
}

void
AddResources(CLI::App & app, Options & options)
{
  app.add_option("--threads", options.Threads, "Number of threads (default: all processors)")
    ->check(CLI::Range(1u, 1024u));
  auto * streams =
    app.add_option("--streams", options.Streams, "Work in at least this many pieces")->check(CLI::Range(1u, 1000000u));
  app
    .add_option("--memory",
                options.Memory,
                "Work in so many pieces that this much memory is enough, such as 500M, 0.5G or 1.5GiB")
    ->type_name("SIZE")
    ->transform(CLI::Validator(BytesToNumber, ""))
    ->excludes(streams);
  app
    .add_option_function<std::string>(
      "--piece",
      [&options](const std::string & text) {
        try
        {
          options.Piece = ParsePieceChoice(CLI::detail::to_lower(text));
        }
        catch (const std::invalid_argument & error)
        {
          throw CLI::ValidationError("--piece", error.what());
        }
      },
      "Make piece K of N of the output, which other processes share that make the others, at any time and on any "
      "machine "
      "that shares the file system; rank: K and N from the environment of a Slurm job array, srun or mpirun; status: "
      "list the pieces that are missing")
    ->type_name("K/N");
}

void
AddOutput(CLI::App & app, Options & options)
{
  app.add_flag("--compress", options.Writing.Compress, "Compress the output where its format can");
  app
    .add_option("--compression-level",
                options.Writing.CompressionLevel,
                "Compress, from 1 (fast) to 9 (small); default: the format's own")
    ->check(CLI::Range(1, 9));
  app.add_flag("--keep-metadata",
               options.Writing.KeepMetadata,
               "Keep what else the input's header says, patients' names included");
}

void
AddMessages(CLI::App & app, Options & options)
{
  auto * json = app.add_flag("--json", options.Json, "Print the summary as a JSON object");
  app.add_flag("--quiet", options.Quiet, "Print nothing but errors, and what --json asks for");
  app.add_flag("--progress-xml", options.ProgressXml, "Report progress on stdout as 3D Slicer reads it")
    ->excludes(json);
}

void
AddTasks(CLI::App & app, Options & options)
{
  const auto add = [&](const char * name, Task task, const char * description) {
    app.add_flag_callback(name, [&options, task] { options.Task = task; }, description);
  };
  add("--info", Task::Inform, "Say what would be read and written, and what that takes; OUTPUT may be left out");
  add("--list-series", Task::ListSeries, "List the DICOM series of the folder INPUT");
  add("--formats", Task::ListFormats, "List the image formats");
  add("--xml", Task::DescribeItself, "Print the description of this program as a 3D Slicer module");
  app.set_version_flag("--version", std::string("SubdivideVolume ") + GetProgramVersion());
}

/** Fills in what was not chosen, and checks the rest. */
void
CompleteScheme(const CLI::App & app, Options & options)
{
  using namespace itk::Subdivision;
  const itk::Subdivision::Options forLabels = LabelSubdivider::GetDefaultOptions();
  if (options.Scheme.empty() || options.Scheme == DefaultScheme)
  {
    options.Scheme = options.Labels ? forLabels.Scheme->Name : Schemes[0].Name;
  }
  const Scheme & scheme = FindScheme(options.Scheme);
  if (app.count("--tension") == 0)
  {
    const bool isForLabels = options.Labels && &scheme == forLabels.Scheme;
    options.Tension = isForLabels ? forLabels.Tension : itk::Subdivision::Options().Tension;
  }
  try
  {
    CheckTension(scheme, options.Tension);
  }
  catch (const std::invalid_argument & error)
  {
    throw UsageError("--tension " + CLI::detail::to_string(options.Tension) + ": " + error.what());
  }
  try
  {
    if (options.Labels)
    {
      LabelSubdivider::CheckScheme(scheme);
    }
  }
  catch (const std::invalid_argument & error)
  {
    throw UsageError(std::string("--labels: ") + error.what());
  }
}

void
CheckTogether(const CLI::App & app, Options & options)
{
  CompleteScheme(app, options);
  if (options.Task != Task::ListFormats && options.Task != Task::DescribeItself)
  {
    Require(options.Input, "INPUT");
  }
  if (options.Task == Task::Subdivide)
  {
    Require(options.Output, "OUTPUT");
  }
  const bool isPiece = options.Piece.Number > 0 || options.Piece.IsStatus;
  if (isPiece && options.Task != Task::Subdivide)
  {
    throw UsageError("--piece makes a piece of an output, which --info and others do not");
  }
  options.Writing.Compress = options.Writing.Compress || options.Writing.CompressionLevel > 0;
  if (isPiece && options.Writing.Compress)
  {
    throw UsageError("--piece: files that several processes write cannot be compressed");
  }
}
} // namespace

std::optional<int>
ParseCommandLine(int argc, char * argv[], Options & options)
{
  CLI::App app("Doubles the resolution of an image with the non-oscillatory subdivision scheme.", "SubdivideVolume");
  app.footer(Footer);
  app.add_option("INPUT", options.Input, "An image file, or a folder with a DICOM series or with slices");
  app.add_option(
    "OUTPUT",
    options.Output,
    "The image file to write, whose ending says the format, or a folder for slices (a name that ends in /)");
  AddComputation(app, options);
  AddInputOptions(app, options.Reading);
  AddRawOption(app, "--raw", options.Reading.Raw, "INPUT");
  AddOutput(app, options);
  AddResources(app, options);
  AddMessages(app, options);
  AddTasks(app, options);
  const std::optional<int> exitCode = ParseArguments(app, argc, argv);
  if (!exitCode)
  {
    CheckTogether(app, options);
  }
  return exitCode;
}
