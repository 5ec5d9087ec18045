// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/Subdivider.h"

#include "NonOscillatorySubdivision/DefaultFloatingPoint.h"
#include "NonOscillatorySubdivision/Geometry.h"
#include "array/Arguments.h"
#include "array/CheckedArithmetic.h"
#include "array/Elements.h"
#include "array/OutputMemory.h"
#include "array/RowReader.h"
#include "array/RowWriter.h"
#include "array/RunPlan.h"
#include "array/ScratchPool.h"

#include <string>

namespace itk
{
namespace Subdivision
{
namespace
{

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

} // namespace

struct Workspace::Implementation
{
  ScratchPool<float>  Float;
  ScratchPool<double> Double;
};

Workspace::Workspace()
  : m_Implementation(std::make_unique<Implementation>())
{}

Workspace::~Workspace() = default;

struct Subdivider::Implementation
{
  RunPlan               Plan;
  TileAxes              Axes;
  Tiling                Tiles;
  ScratchPool<float> &  FloatScratch;
  ScratchPool<double> & DoubleScratch;

  Implementation(const RunPlan & plan, const Options & options, unsigned int threads, Workspace::Implementation & work)
    : Plan(plan)
    , Axes(plan.GetSubdividedAxes())
    , Tiles(plan.MakeTiling(threads))
    , FloatScratch(work.Float)
    , DoubleScratch(work.Double)
  {
    // What this run has no use for is not kept.
    const KernelSettings settings = this->MakeKernelSettings(options);
    FloatScratch.Prepare(settings);
    DoubleScratch.Prepare(settings);
    if (Plan.ComputesInDouble())
    {
      FloatScratch.Clear();
    }
    else
    {
      DoubleScratch.Clear();
    }
  }

  bool
  IsSubdivided(const std::size_t axis) const
  {
    return axis != TileAxes::None && Plan.Axes[axis].IsSubdivided;
  }

  bool
  IsSubdivided() const
  {
    return this->IsSubdivided(Axes.X) || this->IsSubdivided(Axes.Z);
  }

  KernelSettings
  MakeKernelSettings(const Options & options) const
  {
    const TileSize largest = GetTileSize(Axes, [this](const std::size_t axis) { return Tiles.GetTileSize()[axis]; });
    return { &GetScheme(options),
             options.Tension,
             { this->IsSubdivided(Axes.X), this->IsSubdivided(Axes.Y), this->IsSubdivided(Axes.Z) },
             largest,
             Plan.Target };
  }

  void
  ComputeTile(const Box & tile, TileMonitor & monitor)
  {
    if (!this->IsSubdivided() && Plan.InputType == Plan.OutputType)
    {
      this->CopyTile(tile, monitor);
    }
    else if (Plan.ComputesInDouble())
    {
      this->ComputeTileIn(DoubleScratch, tile, monitor);
    }
    else
    {
      this->ComputeTileIn(FloatScratch, tile, monitor);
    }
  }

  /** A tile that is computed with real values: subdivided or, along no axis, from type to type. */
  template <typename TReal>
  void
  ComputeTileIn(ScratchPool<TReal> & pool, const Box & tile, TileMonitor & monitor) const
  {
    const typename ScratchPool<TReal>::Loan scratch(pool);
    RowReader<TReal>                        reader(Plan, Axes, tile);
    RowWriter<TReal>                        writer(Plan, Axes, tile, monitor, scratch->Elements);
    const TileSize size = GetTileSize(Axes, [&tile](const std::size_t axis) { return tile[axis].Size; });
    Axes.ForEachImage(tile, [&](const std::vector<std::int64_t> & position) {
      reader.SetImage(position);
      writer.SetImage(position);
      if (scratch->Kernel)
      {
        scratch->Kernel->Subdivide(size, reader, writer);
      }
      else
      {
        scratch->Values.resize(size.X);
        reader.ReadRow(0, 0, scratch->Values.data());
        writer.WriteRow(0, 0, ChildRow<TReal>(scratch->Values.data(), size.X, false, *Plan.Target));
      }
    });
    writer.Report();
  }

  /** A tile of which no axis is subdivided and no element is changed. */
  void
  CopyTile(const Box & tile, TileMonitor & monitor) const
  {
    Axes.ForEachImage(tile, [&](const std::vector<std::int64_t> & position) {
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
  AdviseHugePages(output);
  const RunPlan plan(input, whole, output, options);
  m_Implementation = std::make_unique<Implementation>(plan, options, threads, *workspace.m_Implementation);
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
    GetLast(whole[axis]); // which must fit, whether the axis is subdivided or not
    output[axis] = subdivided[axis] ? GetChildren(whole[axis]) : whole[axis];
  }
  return output;
}

std::size_t
Subdivider::GetNumberOfTiles() const
{
  return m_Implementation->Tiles.GetNumberOfTiles();
}

void
Subdivider::ComputeTile(const std::size_t number, TileMonitor & monitor)
{
  if (!monitor.IsStopped())
  {
    const DefaultFloatingPoint environment;
    m_Implementation->ComputeTile(m_Implementation->Plan.GetTile(m_Implementation->Tiles, number), monitor);
  }
}

} // namespace Subdivision
} // namespace itk
