// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/LabelSubdivider.h"

#include "NonOscillatorySubdivision/DefaultFloatingPoint.h"
#include "NonOscillatorySubdivision/Geometry.h"
#include "array/Arguments.h"
#include "array/LabelBlock.h"
#include "array/LabelElection.h"
#include "array/LabelWriter.h"
#include "array/OutputMemory.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

namespace itk
{
namespace Subdivision
{
namespace
{

/** Voxels of a block along x, y and z, found by measurement: little halo, and few blocks with more than one label. */
constexpr std::uint64_t BlockSize[3][3] = { { 4096, 1, 1 }, { 256, 1, 64 }, { 48, 16, 16 } };

/** A scheme without a tension ignores what there is, such as the default of labels, which other checks refuse. */
Options
ReplaceIgnoredTension(Options options)
{
  if (!GetScheme(options).HasTension())
  {
    options.Tension = Options().Tension;
  }
  return options;
}

/** \throw std::invalid_argument if anything does not fit */
const Scheme &
GetCheckedScheme(const ConstArrayView & input, const Box & whole, const ArrayView & output, const Options & options)
{
  CheckArguments(input, whole, output, options);
  if (!IsInteger(input.Type) || !IsInteger(output.Type))
  {
    throw std::invalid_argument("labels are integers, not " + std::string(GetName(input.Type)) + " to " +
                                GetName(output.Type));
  }
  LabelSubdivider::CheckScheme(GetScheme(options));
  return GetScheme(options);
}

} // namespace

struct LabelSubdivider::Implementation
{
  Implementation(const ConstArrayView & input, const Box & whole, const ArrayView & output, const Options & options);

  void
  SplitIntoBlocks();

  /** The block of that number. */
  LabelBlockPlace
  GetPlace(std::size_t number) const;

  template <typename T>
  std::size_t
  ComputeBlock(std::size_t number);

  /** Whether a block and the voxels around it lie in the input and have one label: \c label. */
  template <typename T>
  bool
  HasOneLabel(const LabelBlockPlace & place, T & label) const;

  std::unique_ptr<Kernel<double>>
  BorrowKernel();
  void
  ReturnKernel(std::unique_ptr<Kernel<double>> kernel);

  const ConstArrayView Input;
  const Box            Whole;
  const ArrayView      Output;
  const Options        What;
  const Scheme &       UsedScheme;
  const LabelBlockAxes BlockAxes;
  const LabelWriter    Writer;

  Box                        Parents;
  std::vector<std::uint64_t> Size;   // of a block, along every axis of the array
  std::vector<std::uint64_t> Blocks; // along every axis of the array

  std::mutex                                   Mutex;
  std::vector<std::unique_ptr<Kernel<double>>> IdleKernels;
};

LabelSubdivider::Implementation::Implementation(const ConstArrayView & input,
                                                const Box &            whole,
                                                const ArrayView &      output,
                                                const Options &        options)
  : Input(input)
  , Whole(whole)
  , Output(output)
  , What(ReplaceIgnoredTension(options))
  , UsedScheme(GetCheckedScheme(input, whole, output, What))
  , BlockAxes(LabelBlockAxes::Choose(options.SubdividedAxes, whole))
  , Writer(output, BlockAxes)
{
  this->SplitIntoBlocks();
}

void
LabelSubdivider::Implementation::SplitIntoBlocks()
{
  Size.assign(Output.Axes.size(), 1);
  int dimensions = 0;
  for (const int axis : BlockAxes.Number)
  {
    dimensions += axis >= 0 ? 1 : 0;
  }
  for (int i = 0; i < 3; ++i)
  {
    if (BlockAxes.Number[i] >= 0)
    {
      Size[BlockAxes.Number[i]] = BlockSize[dimensions - 1][i];
    }
  }
  for (std::size_t axis = 0; axis < Output.Axes.size(); ++axis)
  {
    const Interval interval{ Output.Axes[axis].First, Output.Axes[axis].Size };
    Parents.push_back(What.SubdividedAxes[axis] ? GetParents(interval) : interval);
    Size[axis] = std::min(Size[axis], Parents[axis].Size);
    Blocks.push_back((Parents[axis].Size + Size[axis] - 1) / Size[axis]);
  }
}

LabelBlockPlace
LabelSubdivider::Implementation::GetPlace(std::size_t number) const
{
  LabelBlockPlace place{ { { { 0, 1 }, { 0, 1 }, { 0, 1 } } }, { 0, 0, 0 }, {} };
  for (std::size_t axis = 0; axis < Blocks.size(); ++axis)
  {
    const std::uint64_t offset = number % Blocks[axis] * Size[axis];
    number /= Blocks[axis];
    place.Position.push_back(Parents[axis].First + static_cast<std::int64_t>(offset));
    const auto i = std::find(BlockAxes.Number.begin(), BlockAxes.Number.end(), static_cast<int>(axis));
    if (i != BlockAxes.Number.end())
    {
      place.Voxels[i - BlockAxes.Number.begin()] = { place.Position.back(),
                                                     std::min(Size[axis], Parents[axis].Size - offset) };
    }
  }
  for (int i = 0; i < 3; ++i)
  {
    place.Halo[i] = BlockAxes.IsSubdivided[i] ? UsedScheme.Radius() : 0;
  }
  return place;
}

template <typename T>
bool
LabelSubdivider::Implementation::HasOneLabel(const LabelBlockPlace & place, T & label) const
{
  const T *                     data = static_cast<const T *>(Input.Data);
  std::array<std::ptrdiff_t, 3> size{ 1, 1, 1 };
  std::array<std::ptrdiff_t, 3> stride{ 0, 0, 0 };
  for (std::size_t axis = 0; axis < Input.Axes.size(); ++axis)
  {
    const ArrayAxis & stored = Input.Axes[axis];
    // What lies around the voxels and in the image has to have their label, too; what lies outside may be anything.
    std::int64_t first = place.Position[axis] - stored.First;
    const auto   i = std::find(BlockAxes.Number.begin(), BlockAxes.Number.end(), static_cast<int>(axis));
    if (i != BlockAxes.Number.end())
    {
      const auto         tileAxis = i - BlockAxes.Number.begin();
      const std::int64_t around = BlockAxes.IsSubdivided[tileAxis] ? 1 : 0;
      const auto         end = first + static_cast<std::int64_t>(place.Voxels[tileAxis].Size) + around;
      first -= around;
      if (first < 0 || end > static_cast<std::int64_t>(stored.Size))
      {
        return false;
      }
      size[tileAxis] = end - first;
      stride[tileAxis] = stored.Stride;
    }
    data += static_cast<std::ptrdiff_t>(first) * stored.Stride;
  }
  label = *data;
  for (std::ptrdiff_t z = 0; z < size[2]; ++z)
  {
    for (std::ptrdiff_t y = 0; y < size[1]; ++y)
    {
      const T * const row = data + z * stride[2] + y * stride[1];
      bool            differs = false;
      for (std::ptrdiff_t x = 0; x < size[0]; ++x)
      {
        differs |= row[x * stride[0]] != label;
      }
      if (differs)
      {
        return false;
      }
    }
  }
  return true;
}

std::unique_ptr<Kernel<double>>
LabelSubdivider::Implementation::BorrowKernel()
{
  {
    const std::lock_guard<std::mutex> lock(Mutex);
    if (!IdleKernels.empty())
    {
      auto kernel = std::move(IdleKernels.back());
      IdleKernels.pop_back();
      return kernel;
    }
  }
  std::array<std::size_t, 3> largest{ 1, 1, 1 };
  for (int i = 0; i < 3; ++i)
  {
    if (BlockAxes.Number[i] >= 0)
    {
      largest[i] = static_cast<std::size_t>(Size[BlockAxes.Number[i]]);
    }
  }
  const Axes subdivided{ BlockAxes.IsSubdivided[0], BlockAxes.IsSubdivided[1], BlockAxes.IsSubdivided[2] };
  return std::make_unique<Kernel<double>>(UsedScheme,
                                          What.Tension,
                                          subdivided,
                                          TileSize{ largest[0], largest[1], largest[2] },
                                          What.Target != nullptr ? *What.Target : Target::Fastest());
}

void
LabelSubdivider::Implementation::ReturnKernel(std::unique_ptr<Kernel<double>> kernel)
{
  const std::lock_guard<std::mutex> lock(Mutex);
  IdleKernels.push_back(std::move(kernel));
}

template <typename T>
std::size_t
LabelSubdivider::Implementation::ComputeBlock(const std::size_t number)
{
  const LabelBlockPlace place = this->GetPlace(number);
  T                     label{};
  if (this->HasOneLabel(place, label))
  {
    return Writer.Fill(place, label);
  }
  std::vector<T>                   labels;
  std::vector<std::uint8_t>        mixed;
  const std::array<std::size_t, 3> length{ place.GetLength(0), place.GetLength(1), place.GetLength(2) };
  GatherLabels(Input, Whole, What.Boundary, BlockAxes, place, labels);
  FindMixed(labels, length, BlockAxes.IsSubdivided, mixed);

  LabelElection<T> election(labels, mixed, length, place.Halo, BlockAxes.IsSubdivided);
  if (std::find(mixed.begin(), mixed.end(), 1) != mixed.end())
  {
    // The restored scheme keeps each indicator within the range of the voxels around the parent.
    const int  reach = UsedScheme.IsBounded ? 1 : UsedScheme.Radius();
    const bool isExact = !UsedScheme.HasTension() || What.Tension == 0;
    auto       kernel = this->BorrowKernel();
    election.Run(*kernel, reach, isExact);
    this->ReturnKernel(std::move(kernel));
  }
  return Writer.Copy(place, election.GetWinners());
}

Options
LabelSubdivider::GetDefaultOptions()
{
  Options options;
  options.Scheme = &FindScheme("restored");
  options.Tension = 0;
  return options;
}

void
LabelSubdivider::CheckScheme(const Scheme & scheme)
{
  if (scheme.Limited == Correction::SecondDifferences || (scheme.IsBounded && !scheme.IsSharpened))
  {
    throw std::invalid_argument("labels are subdivided by the scheme restored, bspline or linear, not " +
                                std::string(scheme.Name));
  }
}

LabelSubdivider::LabelSubdivider(const ConstArrayView & input,
                                 const Box &            whole,
                                 const ArrayView &      output,
                                 const Options &        options)
  : m_Implementation(new Implementation(input, whole, output, options))
{
  AdviseHugePages(output);
}

LabelSubdivider::~LabelSubdivider() = default;

std::size_t
LabelSubdivider::GetNumberOfTiles() const
{
  std::size_t tiles = 1;
  for (const std::uint64_t blocks : m_Implementation->Blocks)
  {
    tiles *= static_cast<std::size_t>(blocks);
  }
  return tiles;
}

void
LabelSubdivider::ComputeTile(const std::size_t number, TileMonitor & monitor)
{
  if (monitor.IsStopped())
  {
    return;
  }
  const DefaultFloatingPoint environment;
  monitor.Completed(WithElementType(m_Implementation->Input.Type, [&](auto tag) -> std::size_t {
    using Type = typename decltype(tag)::Type;
    if constexpr (std::is_integral<Type>::value)
    {
      return m_Implementation->ComputeBlock<Type>(number);
    }
    return 0;
  }));
}

} // namespace Subdivision
} // namespace itk
