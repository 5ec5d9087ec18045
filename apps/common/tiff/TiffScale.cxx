// SPDX-License-Identifier: Apache-2.0
#include "tiff/TiffScale.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace
{
/** Pixels per unit of length, if that can be meant. */
std::optional<double>
GetResolution(TIFF * tiff, std::uint32_t tag)
{
  float resolution = 0.0f;
  if (TIFFGetField(tiff, tag, &resolution) == 0 || !std::isfinite(resolution) || !(resolution > 0.0f))
  {
    return std::nullopt;
  }
  return static_cast<double>(resolution);
}

/** The shortest number that the digits of a float stand for: libtiff makes one of a ratio. */
double
RoundToFloat(double number)
{
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.7g", number);
  return std::strtod(text.data(), nullptr);
}

bool
IsForPrinting(double resolution, std::uint16_t unit)
{
  const double perInch = unit == RESUNIT_CENTIMETER ? resolution * 2.54 : resolution;
  const auto   isAbout = [perInch](double value) { return std::abs(perInch - value) < 0.01; };
  return resolution == 1.0 || (unit != RESUNIT_NONE && (isAbout(72.0) || isAbout(96.0)));
}
} // namespace

std::string
GetTiffDescription(TIFF * tiff)
{
  const char * text = nullptr;
  return TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text) != 0 && text != nullptr ? text : "";
}

void
CompleteTiffSpacing(TiffStack & stack, TIFF * tiff)
{
  const auto x = GetResolution(tiff, TIFFTAG_XRESOLUTION);
  const auto y = GetResolution(tiff, TIFFTAG_YRESOLUTION);
  if (!x || !y || stack.Spacing[0] || stack.Spacing[1])
  {
    return;
  }
  std::uint16_t unit = RESUNIT_INCH;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_RESOLUTIONUNIT, &unit);
  // ImageJ's own unit is that of its resolution, too, and is applied to both.
  std::optional<double> own;
  if (stack.IsImageJ)
  {
    const auto description = GetTiffDescription(tiff);
    const auto begin = description.find("\nunit=");
    if (begin != std::string::npos)
    {
      own = GetMillimetres(description.substr(begin + 6, description.find_first_of("\r\n", begin + 1) - begin - 6));
    }
  }
  // A resolution without a unit says at most how wide pixels are to their height; ImageJ's own is in pixels.
  if (!own && unit == RESUNIT_NONE && !stack.IsImageJ)
  {
    stack.HasOtherUnit = *x != 1.0 || *y != 1.0;
    return;
  }
  if (!own && (IsForPrinting(*x, unit) || IsForPrinting(*y, unit)))
  {
    return;
  }
  const double millimetres = own ? *own : unit == RESUNIT_CENTIMETER ? 10.0 : unit == RESUNIT_INCH ? 25.4 : 1.0;
  stack.IsInMillimetres = own || unit == RESUNIT_CENTIMETER || unit == RESUNIT_INCH;
  stack.Spacing[0] = RoundToFloat(millimetres / *x);
  stack.Spacing[1] = RoundToFloat(millimetres / *y);
}

std::vector<double>
GetTiffSpacing(const TiffStack & stack, const std::string & name, bool isVolume, const WarningSink & warn)
{
  std::vector<double> spacing = { stack.Spacing[0].value_or(1.0), stack.Spacing[1].value_or(1.0) };
  if (stack.HasOtherUnit && !stack.Spacing[0])
  {
    warn(name + " has a resolution without a unit, which says no spacing: 1 is assumed; --spacing says it");
  }
  if (isVolume)
  {
    const bool isPlaneKnown = stack.Spacing[0].has_value() && stack.Spacing[1].has_value();
    spacing.push_back(stack.Spacing[2].value_or(spacing[0]));
    if (isPlaneKnown && !stack.Spacing[2])
    {
      warn(name +
           " does not say how far apart its slices are: " + "as far as its columns is assumed; --spacing says it");
    }
    if (!isPlaneKnown && stack.Spacing[2])
    {
      warn(name + " says how far apart its slices are, but not its columns and rows: 1 is assumed; --spacing says it");
    }
  }
  return spacing;
}
