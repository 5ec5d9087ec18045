// SPDX-License-Identifier: Apache-2.0
#include "array/RunPlan.h"

#include "NonOscillatorySubdivision/Geometry.h"
#include "array/Arguments.h"
#include "array/CheckedArithmetic.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace itk
{
namespace Subdivision
{
namespace
{

/** Rows that are carried are at least this long. Shorter ones, the components of a pixel above all, are worth less than
 * rows along the next axis, whose elements lie apart. */
constexpr std::uint64_t ShortestCarriedRow = 32;

/** How far elements lie apart, for the order of axes. Those that lie at the same place come last. */
std::uint64_t
GetDistance(const ArrayAxis & axis)
{
  const auto stride = static_cast<std::uint64_t>(axis.Stride);
  return axis.Stride == 0 ? std::numeric_limits<std::uint64_t>::max() : axis.Stride < 0 ? 0 - stride : stride;
}

/** The axes in the order of memory, the fastest first. It follows the input: that of the output would make results
 * depend on the box that is asked for. A subdivided axis of one element, of which the whole has no more, follows the
 * one before it, whatever its stride: the order of the subdivided axes, in which children are summed up, is that of all
 * parts of an input. */
std::vector<std::size_t>
OrderAxes(const std::vector<ArrayAxis> & axes, const Box & whole, const Flags & subdivided)
{
  const auto               isLong = [&](const std::size_t axis) { return subdivided[axis] && whole[axis].Size > 1; };
  std::vector<std::size_t> order(axes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto first = std::find_if(order.begin(), order.end(), isLong);
  const auto last = std::find_if(order.rbegin(), order.rend(), isLong);
  if (first != order.end() && GetDistance(axes[*first]) > GetDistance(axes[*last]))
  {
    std::reverse(order.begin(), order.end());
  }
  std::vector<std::uint64_t> distances(axes.size());
  std::uint64_t              before = 0;
  for (const std::size_t axis : order)
  {
    distances[axis] = subdivided[axis] && !isLong(axis) ? before : GetDistance(axes[axis]);
    before = isLong(axis) ? distances[axis] : before;
  }
  std::stable_sort(order.begin(), order.end(), [&distances](const std::size_t a, const std::size_t b) {
    return distances[a] < distances[b];
  });
  return order;
}

/** How many axes at the front of the order lie within rows along the next one, which is x: none where x is the fastest
 * axis, subdivided or carried. */
std::size_t
CountInnerAxes(const std::vector<std::size_t> & order, const Box & whole, const Flags & subdivided)
{
  std::size_t   inner = 0;
  std::uint64_t row = 1;
  while (inner < order.size() && !subdivided[order[inner]])
  {
    row = std::min(row, ShortestCarriedRow) * std::min(whole[order[inner]].Size, ShortestCarriedRow);
    ++inner;
  }
  const bool isCarried = row >= ShortestCarriedRow && std::count(subdivided.begin(), subdivided.end(), true) < 3;
  return isCarried || inner == order.size() ? 0 : inner;
}

RunAxis
MakeAxis(const std::size_t      number,
         const ConstArrayView & input,
         const Interval &       whole,
         const ArrayView &      output,
         const bool             isSubdivided,
         const int              radius)
{
  const Interval outputs = { output.Axes[number].First, output.Axes[number].Size };
  const Interval parents = isSubdivided ? GetParents(outputs) : outputs;
  const Interval stencil = isSubdivided ? GetStencil(outputs, radius) : outputs;
  RunAxis        axis;
  axis.Parts = { { number, parents.First, parents.Size } };
  axis.IsSubdivided = isSubdivided;
  axis.Parents = parents.Size;
  axis.Stencil = { CheckedSubtract(stencil.First, parents.First), stencil.Size };
  axis.Whole = { CheckedSubtract(whole.First, parents.First), whole.Size };
  axis.FirstOutput = isSubdivided ? outputs.First - Children * parents.First : 0;
  axis.Outputs = outputs.Size;
  axis.InputStep = input.Axes[number].Stride * static_cast<std::ptrdiff_t>(SizeOf(input.Type));
  axis.OutputStep = output.Axes[number].Stride * static_cast<std::ptrdiff_t>(SizeOf(output.Type));
  return axis;
}

bool
IsContinuedBy(const RunAxis & axis, const RunAxis & next)
{
  const auto size = static_cast<std::ptrdiff_t>(axis.Parents);
  return !axis.IsSubdivided && !next.IsSubdivided && axis.InputStep * size == next.InputStep &&
         axis.OutputStep * size == next.OutputStep;
}

/** Makes one axis of two that are not subdivided. */
void
Append(RunAxis & axis, const RunAxis & next)
{
  axis.Parts.insert(axis.Parts.end(), next.Parts.begin(), next.Parts.end());
  axis.Parents *= next.Parents;
  axis.Stencil = axis.Whole = { 0, axis.Parents };
  axis.Outputs = axis.Parents;
}

} // namespace

RunPlan::RunPlan(const ConstArrayView & input, const Box & whole, const ArrayView & output, const Options & options)
  : Input(static_cast<const unsigned char *>(input.Data))
  , Output(static_cast<unsigned char *>(output.Data))
  , InputType(input.Type)
  , OutputType(output.Type)
  , Radius(GetScheme(options).Radius())
  , Boundary(options.Boundary)
  , Target(options.Target ? options.Target : &Subdivision::Target::Fastest())
  , FirstConstant(whole[0].First)
  , ArrayAxes(whole.size())
{
  std::vector<std::size_t> order = OrderAxes(input.Axes, whole, options.SubdividedAxes);
  const std::size_t        inner = CountInnerAxes(order, whole, options.SubdividedAxes);
  std::rotate(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(inner), order.end());
  for (const std::size_t number : order)
  {
    RunAxis axis = MakeAxis(number, input, whole[number], output, options.SubdividedAxes[number], Radius);
    Input += (axis.Parts[0].First - input.Axes[number].First) * axis.InputStep;
    if (Axes.size() == 1 && IsContinuedBy(Axes[0], axis))
    {
      Append(Axes[0], axis);
    }
    else
    {
      Axes.push_back(std::move(axis));
    }
  }
  CutAxes = Axes.size() - inner;
}

Flags
RunPlan::GetSubdividedAxes() const
{
  Flags flags;
  for (const RunAxis & axis : Axes)
  {
    flags.push_back(axis.IsSubdivided);
  }
  return flags;
}

Tiling
RunPlan::MakeTiling(const unsigned int threads) const
{
  Sizes parents;
  Flags subdivided;
  for (std::size_t axis = 0; axis < CutAxes; ++axis)
  {
    parents.push_back(Axes[axis].Parents);
    subdivided.push_back(Axes[axis].IsSubdivided);
  }
  return Tiling(parents, subdivided, Radius, threads);
}

Box
RunPlan::GetTile(const Tiling & tiling, const std::size_t number) const
{
  Box tile = tiling.GetTile(number);
  for (std::size_t axis = CutAxes; axis < Axes.size(); ++axis)
  {
    tile.push_back({ 0, Axes[axis].Parents });
  }
  return tile;
}

} // namespace Subdivision
} // namespace itk
