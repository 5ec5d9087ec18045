// SPDX-License-Identifier: Apache-2.0
#include "array/Arguments.h"

#include "NonOscillatorySubdivision/Geometry.h"
#include "array/CheckedArithmetic.h"
#include "array/TileAxes.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

namespace itk
{
namespace Subdivision
{
namespace
{

std::string
ToString(const Interval & interval)
{
  return std::to_string(interval.Size) + " elements from index " + std::to_string(interval.First);
}

void
CheckNumberOfAxes(const std::string & what, const std::size_t number, const std::size_t expected)
{
  if (number != expected)
  {
    throw std::invalid_argument(what + " has " + std::to_string(number) + " axes, but the whole input has " +
                                std::to_string(expected));
  }
}

void
CheckNotEmpty(const std::string & what, const Box & box)
{
  for (std::size_t axis = 0; axis < box.size(); ++axis)
  {
    if (box[axis].Size == 0)
    {
      throw std::invalid_argument(what + " has size 0 along axis " + std::to_string(axis) +
                                  ", but must have at least 1");
    }
  }
}

bool
Contains(const Interval & outer, const Interval & inner)
{
  return inner.First >= outer.First && GetLast(inner) <= GetLast(outer);
}

void
CheckContains(const std::string & outerName, const Box & outer, const std::string & innerName, const Box & inner)
{
  for (std::size_t axis = 0; axis < outer.size(); ++axis)
  {
    if (!Contains(outer[axis], inner[axis]))
    {
      throw std::invalid_argument(outerName + " has " + ToString(outer[axis]) + " along axis " + std::to_string(axis) +
                                  ", but " + innerName + " has " + ToString(inner[axis]));
    }
  }
}

/** Elements lie apart, where they are written, and their distances in bytes can be computed. */
template <typename TVoid>
void
CheckView(const std::string & what, const BasicArrayView<TVoid> & view)
{
  if (!view.Data)
  {
    throw std::invalid_argument(what + " has no data");
  }
  std::uint64_t extent = SizeOf(view.Type);
  for (const ArrayAxis & axis : view.Axes)
  {
    // The magnitude of the least stride is no stride.
    const auto magnitude = axis.Stride < 0 ? 0 - static_cast<std::uint64_t>(axis.Stride) : axis.Stride;
    const auto bytes = CheckedMultiply(CheckedMultiply(axis.Size - 1, magnitude), SizeOf(view.Type));
    extent = CheckedAdd(CheckedSigned(extent), CheckedSigned(bytes));
  }
  if (extent > static_cast<std::uint64_t>(std::numeric_limits<std::ptrdiff_t>::max()))
  {
    throw std::overflow_error(what + " reaches farther than memory does");
  }
}

void
CheckOutputStrides(const ArrayView & output)
{
  for (std::size_t axis = 0; axis < output.Axes.size(); ++axis)
  {
    if (output.Axes[axis].Stride == 0 && output.Axes[axis].Size > 1)
    {
      throw std::invalid_argument("the output has stride 0 along axis " + std::to_string(axis) +
                                  ", but its elements must lie apart");
    }
  }
}

void
CheckBoundary(const Options & options, const Box & whole)
{
  const std::size_t constants = options.Boundary.GetConstants().size();
  if (constants <= 1)
  {
    return;
  }
  if (options.SubdividedAxes[0])
  {
    throw std::invalid_argument("the boundary has " + std::to_string(constants) +
                                " constants, but must have a single one where axis 0 is subdivided");
  }
  if (constants != whole[0].Size)
  {
    throw std::invalid_argument("the boundary has " + std::to_string(constants) +
                                " constants, but must have one, or as many as axis 0, " +
                                std::to_string(whole[0].Size));
  }
}

/** What is read of the input itself. Whom a custom boundary asks has what that needs. */
Box
GetReadBox(const Box & output, const Box & whole, const Options & options)
{
  Options withinArray = options;
  if (options.Boundary.GetElements())
  {
    withinArray.Boundary = Boundary::Nearest();
  }
  return Subdivider::GetInputRequest(output, whole, withinArray);
}

} // namespace

const Scheme &
GetScheme(const Options & options)
{
  return options.Scheme ? FindScheme(options.Scheme->Name) : Schemes[0];
}

void
CheckBoxes(const Box & output, const Box & whole, const Options & options)
{
  CheckNumberOfAxes("the output", output.size(), whole.size());
  CheckNumberOfAxes("SubdividedAxes", options.SubdividedAxes.size(), whole.size());
  TileAxes(options.SubdividedAxes);
  CheckNotEmpty("the whole input", whole);
  CheckNotEmpty("the output", output);
  CheckContains("the whole output", Subdivider::GetWholeOutput(whole, options.SubdividedAxes), "the output", output);
}

void
CheckArguments(const ConstArrayView & input, const Box & whole, const ArrayView & output, const Options & options)
{
  CheckTension(GetScheme(options), options.Tension);
  CheckBoxes(output.GetBox(), whole, options);
  CheckBoundary(options, whole);
  CheckNumberOfAxes("the input", input.Axes.size(), whole.size());
  CheckNotEmpty("the input", input.GetBox());
  CheckContains("the whole input", whole, "the input", input.GetBox());
  CheckContains("the input", input.GetBox(), "what is read of it", GetReadBox(output.GetBox(), whole, options));
  CheckView("the input", input);
  CheckView("the output", output);
  CheckOutputStrides(output);
}

} // namespace Subdivision
} // namespace itk
