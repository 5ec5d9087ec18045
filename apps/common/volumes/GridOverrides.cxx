// SPDX-License-Identifier: Apache-2.0
#include "volumes/GridOverrides.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace
{
std::string
ToText(const std::vector<double> & numbers)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    text << (i == 0 ? "" : ",") << numbers[i];
  }
  return text.str();
}

void
CheckCount(const char * option, const std::vector<double> & numbers, std::size_t axes, const char * orOne)
{
  if (numbers.size() != axes)
  {
    throw std::runtime_error(std::string(option) + ' ' + ToText(numbers) + ": the image has " + std::to_string(axes) +
                             " axes, so " + orOne + std::to_string(axes) + " numbers are needed");
  }
}

bool
AreEqual(const std::vector<double> & a, const std::vector<double> & b)
{
  bool areEqual = a.size() == b.size();
  for (std::size_t i = 0; areEqual && i < a.size(); ++i)
  {
    areEqual = std::abs(a[i] - b[i]) <= 1e-6 * std::max(std::abs(a[i]), std::abs(b[i]));
  }
  return areEqual;
}
} // namespace

void
ApplyOverrides(ImageDescription &   description,
               const InputOptions & options,
               const WarningSink &  warn,
               const bool           saysSpacing)
{
  ImageGrid &       grid = description.Grid;
  const std::size_t axes = grid.Size.size();
  if (options.Spacing)
  {
    std::vector<double> spacing = *options.Spacing;
    if (spacing.size() == 1)
    {
      spacing.assign(axes, spacing.front());
    }
    CheckCount("--spacing", spacing, axes, "1 or ");
    for (const double distance : spacing)
    {
      if (!(distance > 0.0) || !std::isfinite(distance))
      {
        throw std::runtime_error("--spacing " + ToText(*options.Spacing) + ": distances are greater than 0");
      }
    }
    if (saysSpacing && !AreEqual(grid.Spacing, spacing))
    {
      warn("the spacing " + ToText(grid.Spacing) + " of the file is replaced by " + ToText(spacing));
    }
    grid.Spacing = spacing;
  }
  if (options.Origin)
  {
    CheckCount("--origin", *options.Origin, axes, "");
    for (const double place : *options.Origin)
    {
      if (!std::isfinite(place))
      {
        throw std::runtime_error("--origin " + ToText(*options.Origin) + ": places are finite");
      }
    }
    const bool hadOrigin = grid.Origin != std::vector<double>(axes, 0.0);
    if (hadOrigin && !AreEqual(grid.Origin, *options.Origin))
    {
      warn("the origin " + ToText(grid.Origin) + " of the file is replaced by " + ToText(*options.Origin));
    }
    grid.Origin = *options.Origin;
  }
}
