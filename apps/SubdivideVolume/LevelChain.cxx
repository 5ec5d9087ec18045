// SPDX-License-Identifier: Apache-2.0
#include "LevelChain.h"

#include "NonOscillatorySubdivision/Geometry.h"
#include "NonOscillatorySubdivision/LabelSubdivider.h"
#include "NonOscillatorySubdivision/RunTiles.h"
#include "NonOscillatorySubdivision/Target.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace
{
using namespace itk::Subdivision;

Flags
GetSubdividedAxes(const std::string & chosen, const std::size_t dimension)
{
  const std::string letters = std::string("xyzt").substr(0, dimension);
  const std::string axes = chosen.empty() ? letters.substr(0, 3) : chosen;
  if (axes.find_first_not_of(letters) != std::string::npos)
  {
    throw std::runtime_error("--axes " + chosen + ": the image has only the axes " + letters);
  }
  Flags flags(dimension, false);
  for (const char letter : axes)
  {
    flags[letters.find(letter)] = true;
  }
  return flags;
}

/** Whether a voxel can have such a component. */
template <typename T>
bool
HasValue(const double value)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return std::isfinite(static_cast<T>(value));
  }
  // The bounds are powers of two, so they are exact; the largest 64-bit integer is not a double, but one below it is.
  return value == std::floor(value) && value >= static_cast<double>(std::numeric_limits<T>::min()) &&
         value < std::ldexp(1.0, std::numeric_limits<T>::digits);
}

Boundary
MakeBoundary(const std::string & name, const ElementType type)
{
  if (name == "nearest")
  {
    return Boundary::Nearest();
  }
  if (name == "mirror")
  {
    return Boundary::Mirror();
  }
  if (name == "periodic")
  {
    return Boundary::Periodic();
  }
  const double value = std::stod(name);
  if (!WithElementType(type, [value](auto tag) { return HasValue<typename decltype(tag)::Type>(value); }))
  {
    throw std::runtime_error("--boundary " + name + ": it is not a value that a voxel of this image can have");
  }
  return Boundary::Constant({ value });
}

ElementType
GetOutputType(const std::string & name, const ElementType input)
{
  auto type = ElementType::UInt8;
  while (name != "same" && name != GetName(type))
  {
    type = static_cast<ElementType>(static_cast<int>(type) + 1);
  }
  return name == "same" ? input : type;
}

/** The grid of the children of the voxels of a grid. */
ImageGrid
Subdivide(const ImageGrid & grid, const Flags & subdivided)
{
  ImageGrid result = grid;
  for (std::size_t axis = 0; axis < grid.Size.size(); ++axis)
  {
    if (subdivided[axis])
    {
      result.Size[axis] = GetChildren({ 0, grid.Size[axis] }).Size;
      result.Spacing[axis] /= Children;
      for (std::size_t row = 0; row < grid.Origin.size(); ++row)
      {
        result.Origin[row] += grid.Directions[axis][row] * grid.Spacing[axis] * FirstChildPosition;
      }
    }
  }
  return result;
}

/** \throw std::runtime_error if voxels cannot be labels */
void
CheckLabels(const ImageDescription & input, const ElementType output)
{
  if (!IsInteger(input.Component))
  {
    throw std::runtime_error(std::string("--labels: labels are integers, but the voxels are of the type ") +
                             GetName(input.Component));
  }
  if (!IsInteger(output))
  {
    throw std::runtime_error(std::string("--labels: labels are integers, which --output-type ") + GetName(output) +
                             " is not made for");
  }
  if (input.NumberOfComponents > 1)
  {
    throw std::runtime_error("--labels: the voxels have " + std::to_string(input.NumberOfComponents) +
                             " components each; a label is a single number");
  }
}

/** Passes on whether to stop, but not what was done: the levels between are not part of the output. */
class LevelMonitor : public TileMonitor
{
public:
  explicit LevelMonitor(const TileMonitor & monitor)
    : m_Monitor(monitor)
  {}
  void
  Completed(std::size_t) override
  {}
  bool
  IsStopped() const override
  {
    return m_Monitor.IsStopped();
  }

private:
  const TileMonitor & m_Monitor;
};
} // namespace

LevelChain::LevelChain(const ImageDescription & input, const ::Options & options, const unsigned int threads)
  : m_Threads(threads)
  , m_IsOfLabels(options.Labels)
  , m_Components(input.NumberOfComponents)
  , m_Input(input.Component)
  , m_Output(input)
{
  const Flags axes = GetSubdividedAxes(options.Axes, input.Grid.Size.size());
  m_Output.Component = GetOutputType(options.OutputType, input.Component);
  if (m_IsOfLabels)
  {
    CheckLabels(input, m_Output.Component);
    m_BetweenType = m_Input;
  }
  else
  {
    m_BetweenType = NeedsDouble(m_Input) || NeedsDouble(m_Output.Component) ? ElementType::Double : ElementType::Float;
  }

  m_Options.Scheme = &FindScheme(options.Scheme);
  m_Options.Tension = options.Tension;
  m_Options.SubdividedAxes = axes;
  if (m_Components > 1)
  {
    m_Options.SubdividedAxes.insert(m_Options.SubdividedAxes.begin(), false);
  }
  m_Options.Boundary = MakeBoundary(options.Boundary, m_Input);
  m_Options.Target = &Target::Named(options.Target);

  Box whole;
  for (const std::uint64_t size : input.Grid.Size)
  {
    whole.push_back({ 0, size });
  }
  m_Wholes.push_back(this->WithComponents(whole));
  for (unsigned int level = 0; level < options.Levels; ++level)
  {
    m_Output.Grid = Subdivide(m_Output.Grid, axes);
    m_Wholes.push_back(Subdivider::GetWholeOutput(m_Wholes.back(), m_Options.SubdividedAxes));
  }
  m_Between.resize(options.Levels - 1);
}

Box
LevelChain::WithComponents(Box box) const
{
  if (m_Components > 1)
  {
    box.insert(box.begin(), { 0, m_Components });
  }
  return box;
}

Box
LevelChain::WithoutComponents(Box box) const
{
  if (m_Components > 1)
  {
    box.erase(box.begin());
  }
  return box;
}

template <typename TView>
TView
LevelChain::MakeView(const Box & box, const ElementType type, decltype(TView::Data) data) const
{
  TView          view{ data, type, {} };
  std::ptrdiff_t stride = 1;
  for (const Interval & interval : box)
  {
    view.Axes.push_back({ interval.First, interval.Size, stride });
    stride *= static_cast<std::ptrdiff_t>(interval.Size);
  }
  return view;
}

Box
LevelChain::GetWholeOutput() const
{
  return this->WithoutComponents(m_Wholes.back());
}

std::vector<Box>
LevelChain::GetRequests(const Box & piece) const
{
  std::vector<Box> requests(m_Wholes.size() - 1);
  Box              box = this->WithComponents(piece);
  for (std::size_t level = requests.size(); level-- > 0;)
  {
    box = Subdivider::GetInputRequest(box, m_Wholes[level], m_Options);
    requests[level] = box;
  }
  return requests;
}

Box
LevelChain::GetRequest(const Box & piece) const
{
  return this->WithoutComponents(this->GetRequests(piece).front());
}

Box
LevelChain::GetShare(const Box & piece) const
{
  Box share = this->WithComponents(piece);
  for (std::size_t level = 1; level < m_Wholes.size(); ++level)
  {
    for (std::size_t axis = 0; axis < share.size(); ++axis)
    {
      if (m_Options.SubdividedAxes[axis])
      {
        // Of voxel j, the first child is 2 j.
        const std::int64_t first = (share[axis].First + 1) / Children;
        const std::int64_t end = (share[axis].First + static_cast<std::int64_t>(share[axis].Size) + 1) / Children;
        share[axis] = { first, static_cast<std::uint64_t>(end - first) };
      }
    }
  }
  return this->WithoutComponents(share);
}

std::uint64_t
LevelChain::GetScratchBytes(const Box & piece) const
{
  std::uint64_t          bytes = 0;
  const std::vector<Box> requests = this->GetRequests(piece);
  for (std::size_t level = 1; level < requests.size(); ++level)
  {
    bytes += CountElements(requests[level]) * SizeOf(m_BetweenType);
  }
  return bytes;
}

std::unique_ptr<TileRun>
LevelChain::MakeRun(const ConstArrayView & input, const Box & whole, const ArrayView & output)
{
  if (m_IsOfLabels)
  {
    return std::make_unique<LabelSubdivider>(input, whole, output, m_Options);
  }
  return std::make_unique<Subdivider>(input, whole, output, m_Options, m_Threads, m_Workspace);
}

void
LevelChain::Compute(const Box & request, const void * input, const Box & piece, void * output, TileMonitor & monitor)
{
  const std::vector<Box> requests = this->GetRequests(piece);
  LevelMonitor           between(monitor);
  auto                   source = this->MakeView<ConstArrayView>(this->WithComponents(request), m_Input, input);
  for (std::size_t level = 0; level < requests.size(); ++level)
  {
    const bool   isLast = level + 1 == requests.size();
    const Box    box = isLast ? this->WithComponents(piece) : requests[level + 1];
    PageBuffer * buffer = isLast ? nullptr : &m_Between[level];
    if (!isLast)
    {
      buffer->Reserve(CountElements(box) * SizeOf(m_BetweenType));
    }
    const auto target =
      this->MakeView<ArrayView>(box, isLast ? m_Output.Component : m_BetweenType, isLast ? output : buffer->GetData());
    const auto run = this->MakeRun(source, m_Wholes[level], target);
    RunTiles(*run, m_Threads, isLast ? monitor : between);
    source = { target.Data, target.Type, target.Axes };
  }
}
