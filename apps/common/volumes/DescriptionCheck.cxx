// SPDX-License-Identifier: Apache-2.0
#include "volumes/DescriptionCheck.h"
#include "text/HeaderText.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{
/** The volume that the unit vectors of the axes span. */
double
GetDeterminant(std::vector<std::vector<double>> rows)
{
  double determinant = 1.0;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const auto pivot =
      std::max_element(rows.begin() + static_cast<std::ptrdiff_t>(i), rows.end(), [i](const auto & a, const auto & b) {
        return std::abs(a[i]) < std::abs(b[i]);
      });
    std::swap(rows[i], *pivot);
    determinant *= rows[i][i];
    for (std::size_t k = i + 1; k < rows.size() && rows[i][i] != 0.0; ++k)
    {
      const double factor = rows[k][i] / rows[i][i];
      for (std::size_t j = i; j < rows.size(); ++j)
      {
        rows[k][j] -= factor * rows[i][j];
      }
    }
  }
  return determinant;
}

void
CheckSize(const std::string & path, const ImageDescription & description)
{
  const std::size_t axes = description.Grid.Size.size();
  if (axes < 1 || axes > 4)
  {
    FailToRead(path, "it has " + std::to_string(axes) + " axes; up to 4 are supported");
  }
  // In real numbers, since whole numbers overflow silently. The output has 16 times as many bytes in 4D, in double 128
  // times, and a few copies of that still fit a 64-bit number.
  double bytes = static_cast<double>(description.GetVoxelBytes());
  for (const std::uint64_t size : description.Grid.Size)
  {
    bytes *= static_cast<double>(size);
  }
  if (bytes == 0.0)
  {
    FailToRead(path, "the image is empty");
  }
  if (bytes > 1e16)
  {
    FailToRead(path, "an image that large cannot be processed");
  }
}

/** Makes a spacing positive and a direction a unit vector, unless it already is one to within a header's digits. */
void
Normalise(double & spacing, std::vector<double> & direction)
{
  double square = 0.0;
  for (const double number : direction)
  {
    square += number * number;
  }
  double scale = std::abs(std::sqrt(square) - 1.0) > 1e-4 ? std::sqrt(square) : 1.0;
  scale = spacing < 0.0 ? -scale : scale;
  spacing *= scale;
  for (double & number : direction)
  {
    number /= scale;
  }
}
} // namespace

void
CheckDescription(const std::string & path, ImageDescription & description)
{
  CheckSize(path, description);
  ImageGrid & grid = description.Grid;
  for (std::size_t axis = 0; axis < grid.Size.size(); ++axis)
  {
    Normalise(grid.Spacing[axis], grid.Directions[axis]);
    if (!(grid.Spacing[axis] > 0.0) || !std::isfinite(grid.Spacing[axis]))
    {
      FailToRead(path, "the spacing of its axis " + std::to_string(axis) + " is not a positive number");
    }
    if (!std::isfinite(grid.Origin[axis]))
    {
      FailToRead(path, "its origin is not finite");
    }
  }
  if (!(std::abs(GetDeterminant(grid.Directions)) > 1e-6))
  {
    FailToRead(path, "the directions of its axes lie in one plane");
  }
}
