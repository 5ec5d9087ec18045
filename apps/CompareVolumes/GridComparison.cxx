// SPDX-License-Identifier: Apache-2.0
#include "GridComparison.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace
{
/** The place of a corner: of the first voxel along an axis, or of the last where the axis' bit is set. */
std::vector<double>
GetCorner(const ImageGrid & grid, const unsigned int corner)
{
  std::vector<double> place = grid.Origin;
  for (std::size_t axis = 0; axis < grid.Size.size(); ++axis)
  {
    const double index = (corner >> axis & 1) != 0 ? static_cast<double>(grid.Size[axis] - 1) : 0.0;
    for (std::size_t row = 0; row < place.size(); ++row)
    {
      place[row] += index * grid.Spacing[axis] * grid.Directions[axis][row];
    }
  }
  return place;
}

std::string
Join(const std::vector<double> & values)
{
  std::ostringstream text;
  text.precision(9);
  for (const double value : values)
  {
    text << (text.tellp() > 0 ? " " : "") << value;
  }
  return text.str();
}

void
DescribeDifference(std::string &               text,
                   const char *                name,
                   const std::vector<double> & first,
                   const std::vector<double> & second)
{
  if (first != second)
  {
    text += (text.empty() ? "" : ", ") + (name + (" " + Join(first)) + " and " + Join(second));
  }
}
} // namespace

double
GetLargestShift(const ImageGrid & first, const ImageGrid & second)
{
  double largest = 0.0;
  for (unsigned int corner = 0; corner < 1u << first.Size.size(); ++corner)
  {
    const std::vector<double> a = GetCorner(first, corner);
    const std::vector<double> b = GetCorner(second, corner);
    for (std::size_t axis = 0; axis < first.Size.size(); ++axis)
    {
      double shift = 0.0;
      for (std::size_t row = 0; row < a.size(); ++row)
      {
        shift += (b[row] - a[row]) * first.Directions[axis][row];
      }
      largest = std::max(largest, std::abs(shift) / first.Spacing[axis]);
    }
  }
  return largest;
}

std::string
DescribeDifference(const ImageGrid & first, const ImageGrid & second)
{
  std::string text;
  DescribeDifference(text, "Spacing", first.Spacing, second.Spacing);
  DescribeDifference(text, "Origin", first.Origin, second.Origin);
  for (std::size_t axis = 0; axis < first.Directions.size(); ++axis)
  {
    DescribeDifference(text, "Direction", first.Directions[axis], second.Directions[axis]);
  }
  return text;
}
