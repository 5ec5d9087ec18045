// SPDX-License-Identifier: Apache-2.0
#include "itkSubdivisionKernel.h"

#include "itkSubdivisionMasks.h"
#include "itkSubdivisionSweep.h"
#include "itkHugePages.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace itk
{
namespace
{

using SchemeEnum = NonOscillatorySubdivisionImageFilterEnums::Scheme;

/** All usable targets, the fastest first. */
const std::vector<const SubdivisionTarget *> &
Targets()
{
  static const std::vector<const SubdivisionTarget *> targets = [] {
    constexpr int                          maximum = 16;
    std::vector<const SubdivisionTarget *> all;
#ifdef NonOscillatorySubdivision_HAS_HIGHWAY
    all.resize(maximum);
    all.resize(GetVectorisedSubdivisionTargets(all.data(), maximum));
#else
    all.reserve(maximum);
#endif
    all.push_back(&GetPortableSubdivisionTarget());
    return all;
  }();
  return targets;
}

/** What was asked for with SetSubdivisionTarget; null stands for the fastest. */
std::atomic<const SubdivisionTarget *> chosenTarget{ nullptr };

const SubdivisionTarget &
Target()
{
  const SubdivisionTarget * const chosen = chosenTarget;
  return chosen ? *chosen : *Targets().front();
}

template <typename T>
const SubdivisionSweepSteps<T> &
Steps(const SubdivisionTarget & target);

template <>
const SubdivisionSweepSteps<float> &
Steps(const SubdivisionTarget & target)
{
  return target.Float;
}

template <>
const SubdivisionSweepSteps<double> &
Steps(const SubdivisionTarget & target)
{
  return target.Double;
}

constexpr std::size_t CacheLine = 64;

/** Zeroed memory, aligned to cache lines, given out piece by piece. A first pass with no memory behind it counts. */
template <typename T>
class Arena
{
public:
  T *
  Take(const std::size_t count)
  {
    constexpr std::size_t line = CacheLine / sizeof(T);
    T * const             piece = m_Begin ? m_Begin + m_Used : nullptr;
    m_Used += (count + line - 1) / line * line;
    return piece;
  }

  void
  Allocate()
  {
    m_Memory = AllocateOnHugePages(m_Used * sizeof(T));
    m_Begin = static_cast<T *>(m_Memory.get());
    std::memset(m_Memory.get(), 0, m_Used * sizeof(T));
    m_Used = 0;
  }

private:
  HugePageMemory m_Memory;
  T *            m_Begin{ nullptr };
  std::size_t    m_Used{ 0 };
};

/** Vectors reach this many bytes beyond what they are asked for. */
constexpr std::size_t WidestVector = 64;

} // namespace

std::vector<std::string>
GetSubdivisionTargets()
{
  std::vector<std::string> names;
  for (const SubdivisionTarget * const target : Targets())
  {
    names.emplace_back(target->Name);
  }
  return names;
}

void
SetSubdivisionTarget(const std::string & name)
{
  if (name.empty())
  {
    chosenTarget = nullptr;
    return;
  }
  for (const SubdivisionTarget * const target : Targets())
  {
    if (name == target->Name)
    {
      chosenTarget = target;
      return;
    }
  }
  throw std::invalid_argument("no subdivision target \"" + name + "\" on this processor");
}

std::string
GetSubdivisionTarget()
{
  return Target().Name;
}

template <typename TReal>
struct SubdivisionKernel<TReal>::Implementation
{
  const SubdivisionSweepSteps<TReal> & Steps;
  SubdivisionSweep<TReal>              Sweep{};
  std::ptrdiff_t                       Radius;
  Arena<TReal>                         Memory;

  Implementation(SchemeEnum scheme, double tension, unsigned int numberOfAxes, std::size_t width, std::size_t height)
    : Steps(itk::Steps<TReal>(Target()))
    , Radius(GetRadius(scheme))
  {
    Sweep.Scheme = scheme;
    // An infinite product with a threshold of 0 would not be 0.
    Sweep.Tension = std::min<double>(tension, std::numeric_limits<TReal>::max());
    Sweep.HasRowAxis = numberOfAxes > 2;
    Sweep.HasSweepAxis = numberOfAxes > 1;
    LayOut(width, Sweep.HasRowAxis ? height : 1);
    Memory.Allocate();
    LayOut(width, Sweep.HasRowAxis ? height : 1);
  }

  /** Gives every ring and row its memory. */
  void
  LayOut(const std::size_t width, const std::size_t height)
  {
    // Whole vectors may reach further to the left than the halo of the first row.
    Memory.Take(CacheLine / sizeof(TReal));
    constexpr std::size_t line = CacheLine / sizeof(TReal);
    constexpr std::size_t halo = (SubdivisionMasks::ThresholdedRadius + line) / line * line;
    constexpr std::size_t overrun = WidestVector / sizeof(TReal);
    const std::size_t rowLength = (halo + width + SubdivisionMasks::ThresholdedRadius + overrun + line) / line * line;
    const std::size_t rowHalo = Sweep.HasRowAxis ? SubdivisionMasks::ThresholdedRadius : 0;
    Sweep.Pitch = static_cast<std::ptrdiff_t>(rowLength);

    // The same voxel of successive planes shall not compete for the same lines of the cache.
    const auto planeLength = [](const std::size_t values) {
      constexpr std::size_t page = 4096 / sizeof(TReal);
      return (values + page - 1) / page * page + 5 * line;
    };
    const auto row = [&] { return Memory.Take(rowLength) + halo; };
    const auto plane = [&] {
      return Memory.Take(planeLength(rowLength * (height + 2 * rowHalo))) + rowHalo * rowLength + halo;
    };
    const auto planeOfChildren = [&] { return Memory.Take(planeLength(rowLength * height)) + halo; };
    const auto ring = [](auto & entries, const auto & take) {
      for (auto & entry : entries.Entry)
      {
        entry = take();
      }
    };

    const bool isThresholded = Sweep.Scheme == SchemeEnum::NonOscillatory;
    const bool isBounded = Sweep.Scheme == SchemeEnum::BoundedLinear;
    auto &     rows = Sweep.Rows;
    ring(Sweep.Input, plane);
    for (int child = 0; child < 2; ++child)
    {
      ring(Sweep.FlatChildren[child][0], planeOfChildren);
      if (isThresholded)
      {
        ring(Sweep.FlatChildren[child][1], planeOfChildren);
        ring(Sweep.SteepChildren[child][0], planeOfChildren);
        ring(Sweep.SteepChildren[child][1], planeOfChildren);
      }
    }
    for (auto & childrenOfPlane : Sweep.SweepChildren)
    {
      for (auto & children : childrenOfPlane)
      {
        children[0] = row();
        children[1] = row();
      }
    }
    Sweep.Children = Memory.Take(2 * rowLength);
    if (isThresholded)
    {
      for (int subset = 0; subset < SubsetsInPlane; ++subset)
      {
        ring(Sweep.SteepWindows[subset].Pair, plane);
        ring(Sweep.SteepWindows[subset].Later, plane);
        Sweep.KeptSlopeSums[subset] = subset == NoAxisInPlane ? nullptr : plane();
        for (auto & limited : Sweep.Limited)
        {
          limited[subset] = Memory.Take(rowLength * SubdivisionSweep<TReal>::LimitedRows) + halo;
        }
      }
      for (int i = 0; i < 2; ++i)
      {
        ring(rows.Slope[i], row);
        rows.KeptRowSums[i] = row();
        rows.KeptBothSums[i] = row();
        rows.LaneSums[i] = row();
        ring(rows.RowSums[i], row);
        rows.BothSums[i] = row();
        ring(rows.BothMinima[i], row);
        ring(rows.SweepCurvature[i], row);
        rows.RowCurvature[i] = row();
      }
    }
    if (isBounded)
    {
      ring(Sweep.SmallestNeighbour, plane);
      ring(Sweep.LargestNeighbour, plane);
      ring(rows.Smallest, row);
      ring(rows.Largest, row);
      for (unsigned int age = 0; age < PlanesPerStep; ++age)
      {
        Sweep.SmallestOfRow[age] = row();
        Sweep.LargestOfRow[age] = row();
      }
    }
  }
};

template <typename TReal>
SubdivisionKernel<TReal>::SubdivisionKernel(SchemeEnum   scheme,
                                            double       tension,
                                            unsigned int numberOfAxes,
                                            std::size_t  maximumWidth,
                                            std::size_t  maximumHeight)
  : m_Implementation(new Implementation(scheme, tension, numberOfAxes, maximumWidth, maximumHeight))
{}

template <typename TReal>
SubdivisionKernel<TReal>::~SubdivisionKernel() = default;

template <typename TReal>
unsigned int
SubdivisionKernel<TReal>::GetRadius(SchemeEnum scheme)
{
  return scheme == SchemeEnum::NonOscillatory ? SubdivisionMasks::ThresholdedRadius : SubdivisionMasks::ValueRadius;
}

template <typename TReal>
void
SubdivisionKernel<TReal>::GetRecommendedTileSize(unsigned int numberOfAxes, std::size_t & width, std::size_t & height)
{
  // Found by measurement: rows that are long enough for memory to stream, and enough of them to make up for the halo.
  // Smaller tiles would fit a cache nearer to the core, but gain less there than they lose to the halo.
  width = numberOfAxes > 2 ? 256 : 1024;
  height = numberOfAxes > 2 ? 48 : 1;
}

template <typename TReal>
void
SubdivisionKernel<TReal>::StartTile(std::size_t width, std::size_t height, std::size_t depth)
{
  auto & sweep = m_Implementation->Sweep;
  sweep.Width = static_cast<std::ptrdiff_t>(width);
  sweep.Height = sweep.HasRowAxis ? static_cast<std::ptrdiff_t>(height) : 1;
  sweep.Planes = 0;
  sweep.EndPlanes = static_cast<std::ptrdiff_t>(depth) + 2 * m_Implementation->Radius;
}

template <typename TReal>
TReal *
SubdivisionKernel<TReal>::GetInputRow(std::ptrdiff_t row)
{
  const auto & sweep = m_Implementation->Sweep;
  return sweep.Input[0] + row * sweep.Pitch;
}

template <typename TReal>
unsigned int
SubdivisionKernel<TReal>::AdvancePlane()
{
  auto & sweep = m_Implementation->Sweep;
  m_Implementation->Steps.AdvancePlane(sweep);
  sweep.Input.Rotate();
  if (!sweep.HasSweepAxis)
  {
    return 1;
  }
  const std::ptrdiff_t complete = std::max<std::ptrdiff_t>(sweep.Planes - 2 * m_Implementation->Radius, 0);
  if (sweep.Scheme != SchemeEnum::NonOscillatory)
  {
    return static_cast<unsigned int>(std::min<std::ptrdiff_t>(complete, 1));
  }
  return static_cast<unsigned int>(sweep.IsPairComplete() ? std::min<std::ptrdiff_t>(complete, 2) : 0);
}

template <typename TReal>
void
SubdivisionKernel<TReal>::ComputeRow(std::size_t row, unsigned int rowChild, unsigned int planes)
{
  m_Implementation->Steps.ComputeRow(
    m_Implementation->Sweep, static_cast<std::ptrdiff_t>(row), static_cast<int>(rowChild), static_cast<int>(planes));
}

template <typename TReal>
const TReal *
SubdivisionKernel<TReal>::ComputeChildren(unsigned int age, unsigned int sweepChild)
{
  m_Implementation->Steps.ComputeChildren(m_Implementation->Sweep, static_cast<int>(age), static_cast<int>(sweepChild));
  return m_Implementation->Sweep.Children;
}

template class SubdivisionKernel<float>;
template class SubdivisionKernel<double>;

void
InterleaveChildren(const double * children, std::size_t count, double * out)
{
  Target().InterleaveDoubles(children, count, out);
}

#define itkDefineSubdivisionConversions(TPixel, Name)                                                              \
  void ConvertRow(const TPixel * in, std::size_t count, float * out) { Target().Name.ConvertRow(in, count, out); } \
  void InterleaveChildren(const float * children, std::size_t count, TPixel * out)                                 \
  {                                                                                                                \
    Target().Name.InterleaveChildren(children, count, out);                                                        \
  }
itkDefineSubdivisionConversions(std::uint8_t, UInt8) itkDefineSubdivisionConversions(std::int8_t, Int8)
  itkDefineSubdivisionConversions(std::uint16_t, UInt16) itkDefineSubdivisionConversions(std::int16_t, Int16)
    itkDefineSubdivisionConversions(float, Real)

} // namespace itk
