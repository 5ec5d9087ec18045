// SPDX-License-Identifier: Apache-2.0
#include "tiff/TiffStack.h"

#include <cmath>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace
{
using Keys = std::map<std::string, std::string>;

Keys
ParseLines(const std::string & text)
{
  Keys               keys;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    const auto equals = line.find('=');
    const auto last = line.find_last_not_of(" \r\t");
    if (equals != std::string::npos && last > equals)
    {
      keys[line.substr(0, equals)] = line.substr(equals + 1, last - equals);
    }
  }
  return keys;
}

std::uint64_t
GetCount(const Keys & keys, const std::string & key)
{
  const auto found = keys.find(key);
  if (found == keys.end())
  {
    return 1;
  }
  const bool isNumber = found->second.find_first_not_of("0123456789") == std::string::npos;
  const auto count = isNumber && found->second.size() < 10 ? std::stoull(found->second) : 0;
  if (count == 0)
  {
    throw std::runtime_error("its ImageJ description is damaged: " + key + '=' + found->second.substr(0, 40));
  }
  return count;
}

std::optional<double>
GetNumber(const Keys & keys, const std::string & key)
{
  const auto found = keys.find(key);
  if (found == keys.end())
  {
    return std::nullopt;
  }
  std::istringstream stream(found->second);
  stream.imbue(std::locale::classic());
  double number = 0.0;
  return stream >> number ? std::optional<double>(number) : std::nullopt;
}
} // namespace

std::optional<double>
GetMillimetres(const std::string & unit)
{
  // The sign of micro is in the encodings and escapes that ImageJ and OME write.
  static const std::map<std::string, double> units = {
    { "nm", 1e-6 },          { "nanometer", 1e-6 }, { "um", 1e-3 },        { "micron", 1e-3 }, { "microns", 1e-3 },
    { "micrometer", 1e-3 },  { "\xC2\xB5m", 1e-3 }, { "\xCE\xBCm", 1e-3 }, { "\xB5m", 1e-3 },  { "\\u00B5m", 1e-3 },
    { "\\u00b5m", 1e-3 },    { "mm", 1.0 },         { "millimeter", 1.0 }, { "cm", 10.0 },     { "centimeter", 10.0 },
    { "m", 1000.0 },         { "meter", 1000.0 },   { "inch", 25.4 },      { "in", 25.4 },     { "\xC3\x85", 1e-7 },
    { "\xE2\x84\xAB", 1e-7 }
  };
  const auto found = units.find(unit);
  return found == units.end() ? std::nullopt : std::optional<double>(found->second);
}

std::uint64_t
CountPlanes(const TiffStack & stack)
{
  // In real numbers, since whole numbers overflow silently.
  const double planes =
    static_cast<double>(stack.Slices) * static_cast<double>(stack.Channels) * static_cast<double>(stack.Frames);
  if (planes > 1e7)
  {
    throw std::runtime_error("its description is damaged: it has too many planes");
  }
  return stack.Slices * stack.Channels * stack.Frames;
}

std::optional<TiffStack>
ParseImageJ(const std::string & text)
{
  if (text.compare(0, 7, "ImageJ=") != 0)
  {
    return std::nullopt;
  }
  const Keys keys = ParseLines(text);
  TiffStack  stack;
  stack.IsImageJ = true;
  stack.Channels = GetCount(keys, "channels");
  stack.Frames = GetCount(keys, "frames");
  stack.Slices = GetCount(keys, "slices");
  const std::uint64_t images = GetCount(keys, "images");
  if (stack.Channels * stack.Frames == 1 && keys.count("slices") == 0)
  {
    stack.Slices = images;
  }
  if (CountPlanes(stack) != images)
  {
    throw std::runtime_error("its ImageJ description is damaged: " + std::to_string(images) + " images are not " +
                             std::to_string(stack.Channels) + " channels x " + std::to_string(stack.Slices) +
                             " slices x " + std::to_string(stack.Frames) + " frames");
  }
  stack.Planes.resize(images);
  std::iota(stack.Planes.begin(), stack.Planes.end(), 0);

  const auto unit = keys.find("unit");
  const auto millimetres = unit == keys.end() ? std::nullopt : GetMillimetres(unit->second);
  stack.IsInMillimetres = millimetres.has_value();
  const auto spacing = GetNumber(keys, "spacing");
  if (spacing && *spacing != 0.0 && std::isfinite(*spacing))
  {
    // ImageJ writes a negative one where slices go from top to bottom.
    stack.Spacing[2] = std::abs(*spacing) * millimetres.value_or(1.0);
  }
  const double offset = GetNumber(keys, "c0").value_or(0.0);
  const double factor = GetNumber(keys, "c1").value_or(1.0);
  stack.HoldsInt16 = keys.count("cf") != 0 && offset == -32768.0 && factor == 1.0;
  stack.HasCalibration = !stack.HoldsInt16 && keys.count("cf") != 0 && (offset != 0.0 || factor != 1.0);
  return stack;
}
