// SPDX-License-Identifier: Apache-2.0
#include "Summary.h"

#include "SlicerDescription.h"

#include "system/files/DiskRoom.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <sstream>

namespace
{
using nlohmann::ordered_json;

constexpr double Megabyte = 1e6;

template <typename T>
std::string
Join(const std::vector<T> & values, const char * const separator = " x ")
{
  std::ostringstream text;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    text << (i > 0 ? separator : "") << values[i];
  }
  return text.str();
}

std::string
DescribeGrid(const ImageDescription & image)
{
  std::string text = Join(image.Grid.Size) + " " + GetName(image.Component);
  if (image.NumberOfComponents > 1)
  {
    text += " x " + std::to_string(image.NumberOfComponents) + " components";
  }
  return text + ", spacing " + Join(image.Grid.Spacing);
}

std::string
DescribeRange(const Statistics & statistics)
{
  char text[80];
  std::snprintf(text, sizeof(text), "range %g to %g", statistics.Minimum, statistics.Maximum);
  return statistics.HasFinite() ? text : "no finite value";
}

std::string
DescribeCount(const std::uint64_t count, const char * what)
{
  return count > 0 ? ", " + std::to_string(count) + " " + what : "";
}

/** The free space of the disk that a file is to stand on. */
std::optional<std::uint64_t>
GetFreeSpace(const std::string & output)
{
  std::error_code error;
  return GetFreeBytes(std::filesystem::absolute(output, error).parent_path());
}

ordered_json
ToJson(const std::string & path, const ImageDescription & image)
{
  ordered_json object;
  object["path"] = path;
  object["size"] = image.Grid.Size;
  object["spacing"] = image.Grid.Spacing;
  object["origin"] = image.Grid.Origin;
  object["directions"] = image.Grid.Directions;
  object["type"] = GetName(image.Component);
  object["components"] = image.NumberOfComponents;
  return object;
}

void
Include(ordered_json & object, const Statistics & statistics)
{
  object["minimum"] = statistics.Minimum; // null where it is not finite
  object["maximum"] = statistics.Maximum;
  object["nan"] = statistics.NotANumber;
  object["infinite"] = statistics.Infinite;
}

ordered_json
ToJson(const Options & options)
{
  ordered_json object;
  object["program"] = "SubdivideVolume";
  object["version"] = GetProgramVersion();
  object["scheme"] = options.Scheme;
  object["tension"] = options.Tension;
  object["boundary"] = options.Boundary;
  object["levels"] = options.Levels;
  object["labels"] = options.Labels;
  return object;
}

std::string
ToText(const ordered_json & object)
{
  // Names of files need not be UTF-8, but JSON must.
  return object.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string
DescribeWarnings(const std::vector<std::string> & warnings)
{
  std::string text;
  for (const std::string & warning : warnings)
  {
    text += "warning " + warning + "\n";
  }
  return text;
}

/** A number with some decimals. */
std::string
Format(const double number, const int decimals)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", decimals, number);
  return text;
}

std::string
DescribeNumber(const std::size_t number, const char * what)
{
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

ordered_json
ToJson(const Summary & summary)
{
  ordered_json object = ToJson(summary.Options);
  object["input"] = ToJson(summary.Options.Input, summary.Input);
  object["input"]["format"] = summary.Input.Format;
  Include(object["input"], summary.InputStatistics);
  object["output"] = ToJson(summary.Options.Output, summary.Output);
  Include(object["output"], summary.OutputStatistics);
  object["output"]["nan_became_0"] = summary.Losses.NotANumber;
  object["output"]["clamped"] = summary.Losses.Clamped;
  object["warnings"] = summary.Warnings;
  object["pieces"] = summary.Pieces;
  object["threads"] = summary.Threads;
  object["seconds"] = summary.Seconds;
  return object;
}

ordered_json
ToJson(const Forecast & forecast)
{
  ordered_json object = ToJson(forecast.Options);
  object["input"] = ToJson(forecast.Options.Input, forecast.Input);
  object["input"]["format"] = forecast.Input.Format;
  object["output"] = ToJson(forecast.Options.Output, forecast.Output);
  object["output"]["bytes"] = forecast.Output.GetBytes();
  const auto space = GetFreeSpace(forecast.Options.Output);
  object["disk_free_bytes"] = space ? ordered_json(*space) : ordered_json(nullptr);
  object["memory_bytes"] = forecast.Plan.PeakBytes;
  object["pieces"] = forecast.Plan.Pieces.size();
  object["threads"] = forecast.Threads;
  object["warnings"] = forecast.Warnings;
  return object;
}
} // namespace

std::string
Describe(const Summary & summary)
{
  if (summary.Options.Json)
  {
    return ToText(ToJson(summary));
  }
  const Statistics & before = summary.InputStatistics;
  const Statistics & after = summary.OutputStatistics;
  return "input   " + DescribeGrid(summary.Input) + ", " + DescribeRange(before) +
         DescribeCount(before.NotANumber, "NaN") + DescribeCount(before.Infinite, "infinite") + "\noutput  " +
         DescribeGrid(summary.Output) + ", " + DescribeRange(after) + DescribeCount(after.NotANumber, "NaN") +
         DescribeCount(after.Infinite, "infinite") + DescribeCount(summary.Losses.NotANumber, "NaN became 0") +
         DescribeCount(summary.Losses.Clamped, "clamped") + "\n" + DescribeWarnings(summary.Warnings) + "time    " +
         Format(summary.Seconds, 2) + " s, " + DescribeNumber(summary.Pieces, "piece") + "\n";
}

std::string
Describe(const Forecast & forecast)
{
  if (forecast.Options.Json)
  {
    return ToText(ToJson(forecast));
  }
  const auto space = GetFreeSpace(forecast.Options.Output);
  return "input   " + DescribeGrid(forecast.Input) + ", origin " + Join(forecast.Input.Grid.Origin, " ") + ", " +
         forecast.Input.Format + "\noutput  " + DescribeGrid(forecast.Output) + ", origin " +
         Join(forecast.Output.Grid.Origin, " ") + "\ndisk    " +
         Format(static_cast<double>(forecast.Output.GetBytes()) / Megabyte, 1) + " MB uncompressed" +
         (space ? ", " + Format(static_cast<double>(*space) / Megabyte, 1) + " MB free" : "") + "\nmemory  about " +
         Format(static_cast<double>(forecast.Plan.PeakBytes) / Megabyte, 0) + " MB with " +
         DescribeNumber(forecast.Threads, "thread") + ", " + DescribeNumber(forecast.Plan.Pieces.size(), "piece") +
         "\n" + DescribeWarnings(forecast.Warnings);
}
