// SPDX-License-Identifier: Apache-2.0
#include "Options.h"
#include "PixelComponent.h"
#include "SlicerDescription.h"

#include <CLI/CLI.hpp>

#include <cerrno>
#include <cmath>
#include <cstdlib>

namespace
{
std::string
CheckTension(const std::string & text)
{
  double tension = 0.0;
  return CLI::detail::lexical_cast(text, tension) && std::isfinite(tension) && tension > 1.0
           ? std::string()
           : "the tension must be finite and greater than 1, not " + text;
}

bool
IsNumber(const std::string & text)
{
  char * end = nullptr;
  errno = 0;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && errno != ERANGE;
}

std::string
CheckBoundary(const std::string & text)
{
  return text == "nearest" || text == "mirror" || text == "periodic" || IsNumber(text)
           ? std::string()
           : "the boundary must be nearest, mirror, periodic or a number, not " + text;
}

std::string
CheckAxes(const std::string & text)
{
  const bool lettersOnly = text.find_first_not_of("xyzt") == std::string::npos;
  bool       once = true;
  for (const char axis : text)
  {
    once = once && text.find(axis) == text.rfind(axis);
  }
  return !text.empty() && text.size() <= 3 && lettersOnly && once
           ? std::string()
           : "the axes must be one to three different letters of x, y, z and t, not " + text;
}

void
AddOptions(CLI::App & app, Options & options)
{
  app.add_option("INPUT", options.Input, "The image file, or a folder that holds a DICOM series")->required();
  app.add_option("OUTPUT", options.Output, "The image file to write; its ending says the format")->required();

  std::vector<std::string> types = GetPixelComponentNames();
  types.insert(types.begin(), "same");
  app.add_option("--scheme", options.Scheme, "The subdivision scheme")
    ->capture_default_str()
    ->check(CLI::IsMember({ "nonoscillatory", "linear", "bounded", "bspline" }));
  app.add_option("--tension", options.Tension, "How close the non-oscillatory scheme keeps to the linear one; > 1")
    ->capture_default_str()
    ->check(CLI::Validator(CheckTension, ""));
  app.add_option("--boundary", options.Boundary, "Beyond the image: nearest, mirror, periodic or a value")
    ->capture_default_str()
    ->check(CLI::Validator(CheckBoundary, ""));
  app.add_option("--axes", options.Axes, "The axes to subdivide, such as xyz or xy (default: the first three)")
    ->check(CLI::Validator(CheckAxes, ""));
  app.add_option("--output-type", options.OutputType, "The pixel component type of the output")
    ->capture_default_str()
    ->check(CLI::IsMember(types));
  app.add_option("--series", options.Series, "The DICOM series, by its UID, where the folder holds several");
  app.add_option("--threads", options.Threads, "Number of threads (default: all processors)")
    ->check(CLI::Range(1u, 1024u));
  auto * streams =
    app.add_option("--streams", options.Streams, "Work in at least this many pieces, one after the other")
      ->check(CLI::Range(1u, 1000000u));
  app.add_option("--memory", options.Memory, "Work in so many pieces that this much memory is enough, such as 500M")
    ->transform(CLI::AsSizeValue(true))
    ->check(CLI::PositiveNumber)
    ->excludes(streams);
  app.add_flag("--compress", options.Compress, "Compress the output where its format can");
  app.add_flag("--quiet", options.Quiet, "Print nothing but errors");
  app.add_flag("--progress-xml", options.ProgressXml, "Report progress on stdout as 3D Slicer reads it");
  app.set_version_flag("--version", std::string("SubdivideVolume ") + GetProgramVersion());
}
} // namespace

std::optional<int>
ParseCommandLine(int argc, char * argv[], Options & options)
{
  CLI::App app("Doubles the resolution of an image with the non-oscillatory subdivision scheme.", "SubdivideVolume");
  AddOptions(app, options);
  bool xml = false;
  app.add_flag_callback(
    "--xml",
    [&xml] {
      xml = true;
      throw CLI::Success();
    },
    "Print the description of this program as a 3D Slicer module");
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError & error)
  {
    if (xml)
    {
      std::cout << GetSlicerDescription();
      return 0;
    }
    if (error.get_exit_code() == 0)
    {
      return app.exit(error);
    }
    throw UsageError(error.what());
  }
  return std::nullopt;
}
