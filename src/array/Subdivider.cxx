// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/Subdivider.h"

#include "NonOscillatorySubdivision/Geometry.h"
#include "array/Arguments.h"
#include "array/CheckedArithmetic.h"
#include "array/Elements.h"
#include "array/RowReader.h"
#include "array/RowWriter.h"
#include "array/RunPlan.h"
#include "array/ScratchPool.h"

#include <type_traits>

namespace itk
{
namespace Subdivision
{
namespace
{

bool
ComputesInDouble(const RunPlan & plan)
{
  return NeedsDouble(plan.InputType) || NeedsDouble(plan.OutputType);
}

/** Tiles are cut along the first axes of a plan; along the others they are whole. */
Tiling
MakeTiling(const RunPlan & plan, const unsigned int threads)
{
  Sizes parents;
  for (std::size_t axis = 0; axis < plan.CutAxes; ++axis)
  {
    parents.push_back(plan.Axes[axis].Parents);
  }
  Flags subdivided = plan.GetSubdividedAxes();
  subdivided.resize(plan.CutAxes);
  return Tiling(parents, subdivided, plan.Radius, threads);
}

Box
GetTile(const RunPlan & plan, const Tiling & tiling, const std::size_t number)
{
  Box tile = tiling.GetTile(number);
  for (std::size_t axis = plan.CutAxes; axis < plan.Axes.size(); ++axis)
  {
    tile.push_back({ 0, plan.Axes[axis].Parents });
  }
  return tile;
}

/** The size along the axes of a tile, 1 along those that it lacks. */
template <typename TGetSize>
TileSize
GetTileSize(const TileAxes & axes, const TGetSize & getSize)
{
  const auto sizeOf = [&](const std::size_t axis) {
    return axis == TileAxes::None ? std::size_t{ 1 } : static_cast<std::size_t>(getSize(axis));
  };
  return { sizeOf(axes.X), sizeOf(axes.Y), sizeOf(axes.Z) };
}

/** Calls \c visit with each position along the axes that are not those of tiles. */
template <typename TVisitor>
void
ForEachImage(const TileAxes & axes, const Box & tile, const TVisitor & visit)
{
  std::vector<std::int64_t> position;
  for (const Interval & interval : tile)
  {
    position.push_back(interval.First);
  }
  std::size_t axis = 0;
  while (axis < tile.size())
  {
    visit(position);
    for (axis = 0; axis < tile.size(); ++axis)
    {
      const auto end = tile[axis].First + static_cast<std::int64_t>(tile[axis].Size);
      if (!axes.Has(axis) && ++position[axis] < end)
      {
        break;
      }
      position[axis] = tile[axis].First;
    }
  }
}

} // namespace

TileMonitor::~TileMonitor() = default;

struct Workspace::Implementation
{
  ScratchPool<float>  Float;
  ScratchPool<double> Double;

  template <typename TReal>
  ScratchPool<TReal> &
  Get()
  {
    if constexpr (std::is_same<TReal, float>::value)
    {
      return Float;
    }
    else
    {
      return Double;
    }
  }

  /** What is not needed is not kept. */
  void
  Prepare(const KernelSettings & settings, const bool isDouble)
  {
    isDouble ? Double.Prepare(settings) : Float.Prepare(settings);
    isDouble ? Float.Clear() : Double.Clear();
  }
};

Workspace::Workspace()
  : m_Implementation(std::make_unique<Implementation>())
{}

Workspace::~Workspace() = default;

struct Subdivider::Implementation
{
  RunPlan                     Plan;
  TileAxes                    Axes;
  Subdivision::Tiling         Tiling;
  Workspace::Implementation & Scratch;
  /** Computes a tile. */
  void (Implementation::*Compute)(const Box &, TileMonitor &) const;

  Implementation(const RunPlan & plan, const unsigned int threads, Workspace::Implementation & scratch)
    : Plan(plan)
    , Axes(plan.GetSubdividedAxes())
    , Tiling(MakeTiling(plan, threads))
    , Scratch(scratch)
  {}

  void
  Prepare(const Options & options)
  {
    const bool isDouble = ComputesInDouble(Plan);
    const auto isSubdivided = [this](std::size_t axis) {
      return axis != TileAxes::None && Plan.Axes[axis].IsSubdivided;
    };
    const Subdivision::Axes subdivided = { isSubdivided(Axes.X), isSubdivided(Axes.Y), isSubdivided(Axes.Z) };
    if (subdivided.X || subdivided.Z)
    {
      const auto getSize = [this](const std::size_t axis) { return Tiling.GetTileSize()[axis]; };
      Scratch.Prepare({ &GetScheme(options), options.Tension, subdivided, GetTileSize(Axes, getSize), Plan.Target },
                      isDouble);
      Compute = isDouble ? &Implementation::SubdivideTile<double> : &Implementation::SubdivideTile<float>;
    }
    else if (Plan.InputType == Plan.OutputType)
    {
      Compute = &Implementation::CopyTile;
    }
    else
    {
      Compute = isDouble ? &Implementation::ConvertTile<double> : &Implementation::ConvertTile<float>;
    }
  }

  template <typename TReal>
  void
  SubdivideTile(const Box & tile, TileMonitor & monitor) const
  {
    const typename ScratchPool<TReal>::Loan scratch(Scratch.Get<TReal>());
    RowReader<TReal>                        reader(Plan, Axes, tile);
    RowWriter<TReal>                        writer(Plan, Axes, tile, monitor, scratch->Row);
    const TileSize size = GetTileSize(Axes, [&tile](const std::size_t axis) { return tile[axis].Size; });
    ForEachImage(Axes, tile, [&](const std::vector<std::int64_t> & position) {
      reader.SetImage(position);
      writer.SetImage(position);
      scratch->Kernel.Subdivide(size, reader, writer);
    });
  }

  /** A tile of which no axis is subdivided, from type to type. */
  template <typename TReal>
  void
  ConvertTile(const Box & tile, TileMonitor & monitor) const
  {
    std::vector<unsigned char> buffer;
    std::vector<TReal>         row(tile[Axes.X].Size);
    RowReader<TReal>           reader(Plan, Axes, tile);
    RowWriter<TReal>           writer(Plan, Axes, tile, monitor, buffer);
    const ChildRow<TReal>      elements(row.data(), row.size(), false, *Plan.Target);
    ForEachImage(Axes, tile, [&](const std::vector<std::int64_t> & position) {
      reader.SetImage(position);
      writer.SetImage(position);
      reader.ReadRow(0, 0, row.data());
      writer.WriteRow(0, 0, elements);
    });
  }

  /** A tile of which no axis is subdivided and no element is changed. */
  void
  CopyTile(const Box & tile, TileMonitor & monitor) const
  {
    ForEachImage(Axes, tile, [&](const std::vector<std::int64_t> & position) {
      const unsigned char * from = Plan.Input;
      unsigned char *       to = Plan.Output;
      for (std::size_t axis = 0; axis < position.size(); ++axis)
      {
        from += position[axis] * Plan.Axes[axis].InputStep;
        to += position[axis] * Plan.Axes[axis].OutputStep;
      }
      const RunAxis &   x = Plan.Axes[Axes.X];
      const std::size_t count = tile[Axes.X].Size;
      CopyElements(SizeOf(Plan.InputType), from, x.InputStep, count, to, x.OutputStep);
      monitor.Completed(count);
    });
  }
};

Subdivider::Subdivider(const ConstArrayView & input,
                       const Box &            whole,
                       const ArrayView &      output,
                       const Options &        options,
                       const unsigned int     threads,
                       Workspace &            workspace)
{
  CheckArguments(input, whole, output, options);
  const RunPlan plan(input, whole, output, options);
  m_Implementation = std::make_unique<Implementation>(plan, threads, *workspace.m_Implementation);
  m_Implementation->Prepare(options);
}

Subdivider::~Subdivider() = default;

Box
Subdivider::GetInputRequest(const Box & output, const Box & whole, const Options & options)
{
  CheckBoxes(output, whole, options);
  Box  request = output;
  bool isOutside = false;
  for (std::size_t axis = 0; axis < output.size(); ++axis)
  {
    if (options.SubdividedAxes[axis])
    {
      const Interval stencil = GetStencil(output[axis], GetScheme(options).Radius());
      request[axis] = options.Boundary.GetRequest(stencil, whole[axis]);
      isOutside = isOutside || stencil.First < whole[axis].First || GetLast(stencil) > GetLast(whole[axis]);
    }
  }
  // Who is asked for an element outside may read anything for it.
  return isOutside && options.Boundary.GetElements() ? whole : request;
}

Box
Subdivider::GetWholeOutput(const Box & whole, const Flags & subdivided)
{
  if (subdivided.size() != whole.size())
  {
    throw std::invalid_argument("there are flags for " + std::to_string(subdivided.size()) +
                                " axes, but the input has " + std::to_string(whole.size()));
  }
  Box output = whole;
  for (std::size_t axis = 0; axis < whole.size(); ++axis)
  {
    output[axis] = subdivided[axis] ? GetChildren(whole[axis]) : whole[axis];
  }
  return output;
}

std::size_t
Subdivider::GetNumberOfTiles() const
{
  return m_Implementation->Tiling.GetNumberOfTiles();
}

void
Subdivider::ComputeTile(const std::size_t number, TileMonitor & monitor)
{
  if (!monitor.IsStopped())
  {
    const Implementation & run = *m_Implementation;
    (run.*run.Compute)(GetTile(run.Plan, run.Tiling, number), monitor);
  }
}

} // namespace Subdivision
} // namespace itk
