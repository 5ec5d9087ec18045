// SPDX-License-Identifier: Apache-2.0
#include "itk/WrittenImage.h"
#include "itk/ItkReader.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <type_traits>

namespace
{
const char * const AxisNames[] = { "x", "y", "z", "t" };

/** The size without the axes at its end along which there is one voxel. */
std::vector<std::uint64_t>
GetProperSize(std::vector<std::uint64_t> size)
{
  while (size.size() > 1 && size.back() == 1)
  {
    size.pop_back();
  }
  return size;
}

bool
IsSameSpacing(double meant, double found)
{
  return std::abs(meant - found) <= 1e-5 * meant;
}

/** Whether two origins are one to within a thousandth of a voxel. */
bool
IsSameOrigin(const ImageGrid & meant, const ImageGrid & found, std::size_t axes)
{
  for (std::size_t i = 0; i < axes; ++i)
  {
    const double least = *std::min_element(meant.Spacing.begin(), meant.Spacing.end());
    if (std::abs(meant.Origin[i] - found.Origin[i]) > 1e-3 * least)
    {
      return false;
    }
  }
  return true;
}

bool
IsSameDirection(const std::vector<double> & meant, const std::vector<double> & found, std::size_t axes)
{
  for (std::size_t i = 0; i < axes; ++i)
  {
    if (std::abs(meant[i] - found[i]) > 1e-4)
    {
      return false;
    }
  }
  return true;
}

/** Puts 0 for each number of a row that is not finite. */
void
ReplaceNotFinite(std::vector<char> & row, itk::Subdivision::ElementType type)
{
  itk::Subdivision::WithElementType(type, [&row](auto tag) {
    using Type = typename decltype(tag)::Type;
    if constexpr (std::is_floating_point_v<Type>)
    {
      Type * const numbers = reinterpret_cast<Type *>(row.data());
      std::replace_if(
        numbers, numbers + row.size() / sizeof(Type), [](Type number) { return !std::isfinite(number); }, Type{ 0 });
    }
  });
}
} // namespace

std::vector<std::string>
FindLosses(const ImageDescription & meant, const ImageDescription & found)
{
  std::vector<std::string> losses;
  const ImageGrid &        a = meant.Grid;
  const ImageGrid &        b = found.Grid;
  const std::size_t        axes = std::min(a.Size.size(), b.Size.size());
  bool                     isTurned = false;
  for (std::size_t axis = 0; axis < a.Size.size(); ++axis)
  {
    const std::string name = axis < 4 ? AxisNames[axis] : std::to_string(axis);
    if (axis >= axes || !IsSameSpacing(a.Spacing[axis], b.Spacing[axis]))
    {
      losses.push_back("the spacing along " + name);
    }
    isTurned = isTurned || (axis < axes && !IsSameDirection(a.Directions[axis], b.Directions[axis], axes));
  }
  if (!IsSameOrigin(a, b, axes))
  {
    losses.emplace_back("the origin");
  }
  if (isTurned)
  {
    losses.emplace_back("the directions of the axes");
  }
  if (meant.Kind != found.Kind && meant.Kind != VoxelKind::Vector)
  {
    losses.emplace_back("the meaning of the components");
  }
  return losses;
}

bool
HaveSameVoxels(const ImageDescription & meant, const ImageDescription & found)
{
  return GetProperSize(meant.Grid.Size) == GetProperSize(found.Grid.Size) && meant.Component == found.Component &&
         meant.NumberOfComponents == found.NumberOfComponents;
}

bool
HasRows(const std::string & file, const ImageDescription & meant, const void * voxels)
{
  ItkReader                          reader(file);
  const std::vector<std::uint64_t> & size = reader.GetDescription().Grid.Size;
  const std::uint64_t                rowBytes = size[0] * meant.GetVoxelBytes();
  const std::uint64_t                rows = meant.GetNumberOfVoxels() / size[0];
  std::vector<char>                  row(rowBytes);
  const bool                         isFiniteAlone = reader.GetDescription().Format == "NIfTI";
  std::mt19937_64                    random; // the same rows each time
  constexpr int                      numberOfRows = 16;
  for (int i = 0; i < numberOfRows; ++i)
  {
    const std::uint64_t   number = i == 0 ? 0 : i == 1 ? rows - 1 : random() % rows;
    itk::Subdivision::Box box = { { 0, size[0] } };
    std::uint64_t         rest = number;
    for (std::size_t axis = 1; axis < size.size(); ++axis)
    {
      box.push_back({ static_cast<std::int64_t>(rest % size[axis]), 1 });
      rest /= size[axis];
    }
    reader.Read(box, row.data());
    const char * const first = static_cast<const char *>(voxels) + number * rowBytes;
    std::vector<char>  expected(first, first + rowBytes);
    if (isFiniteAlone) // its reader takes the rest for 0
    {
      ReplaceNotFinite(expected, meant.Component);
    }
    if (row != expected)
    {
      return false;
    }
  }
  return true;
}
