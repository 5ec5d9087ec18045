// SPDX-License-Identifier: Apache-2.0
#include "array/RowWriter.h"

#include "array/Elements.h"
#include "array/Losses.h"

#include <algorithm>

namespace itk
{
namespace Subdivision
{
namespace
{

std::uint64_t
GetBytes(const RunPlan & plan)
{
  std::uint64_t bytes = SizeOf(plan.OutputType);
  for (const RunAxis & axis : plan.Axes)
  {
    bytes *= axis.Outputs;
  }
  return bytes;
}

} // namespace

template <typename TReal>
RowWriter<TReal>::RowWriter(const RunPlan &              plan,
                            const TileAxes &             axes,
                            const Box &                  tile,
                            TileMonitor &                monitor,
                            std::vector<unsigned char> & buffer)
  : m_Plan(plan)
  , m_Axes(axes)
  , m_Tile(tile)
  , m_Y(this->GetLine(axes.Y))
  , m_Z(this->GetLine(axes.Z))
  , m_Monitor(monitor)
  , m_CountsLosses(monitor.CountsLosses() && IsInteger(plan.OutputType))
  , m_Bytes(SizeOf(plan.OutputType))
  , m_Step(plan.Axes[axes.X].OutputStep)
  , m_IsLarge(GetBytes(plan) > CacheSize)
  , m_Buffer(buffer)
{
  const Interval     children = this->GetChildren(axes.X);
  const std::int64_t begin = std::max<std::int64_t>(children.First, 0);
  const std::int64_t end = std::min(children.First + static_cast<std::int64_t>(children.Size),
                                    static_cast<std::int64_t>(plan.Axes[axes.X].Outputs));
  m_Skipped = static_cast<std::size_t>(begin - children.First);
  m_Count = static_cast<std::size_t>(end - begin);
  m_Buffer.resize(std::max<std::size_t>(m_Buffer.size(), children.Size * m_Bytes));
}

template <typename TReal>
Interval
RowWriter<TReal>::GetChildren(const std::size_t axis) const
{
  const RunAxis & run = m_Plan.Axes[axis];
  return { run.GetChildren() * m_Tile[axis].First - run.FirstOutput,
           static_cast<std::uint64_t>(run.GetChildren()) * m_Tile[axis].Size };
}

template <typename TReal>
auto
RowWriter<TReal>::GetLine(const std::size_t axis) const -> Line
{
  if (axis == TileAxes::None)
  {
    return {};
  }
  const RunAxis & run = m_Plan.Axes[axis];
  return { this->GetChildren(axis).First, static_cast<std::int64_t>(run.Outputs), run.OutputStep };
}

template <typename TReal>
void
RowWriter<TReal>::SetImage(const std::vector<std::int64_t> & position)
{
  const std::int64_t firstX = std::max<std::int64_t>(this->GetChildren(m_Axes.X).First, 0);
  m_Image = m_Plan.Output + firstX * m_Plan.Axes[m_Axes.X].OutputStep;
  for (std::size_t axis = 0; axis < position.size(); ++axis)
  {
    if (!m_Axes.Has(axis))
    {
      m_Image += position[axis] * m_Plan.Axes[axis].OutputStep;
    }
  }
}

template <typename TReal>
void
RowWriter<TReal>::WriteRow(const std::ptrdiff_t y, const std::ptrdiff_t z, const ChildRow<TReal> & children)
{
  if (!m_Y.Has(y) || !m_Z.Has(z))
  {
    return;
  }
  unsigned char * const row = m_Image + m_Y.GetOffset(y) + m_Z.GetOffset(z);
  const bool            isDense = m_Step == static_cast<std::ptrdiff_t>(m_Bytes);
  if (isDense && !m_IsLarge && m_Count == children.GetSize())
  {
    children.CopyTo(m_Plan.OutputType, row);
    this->CountLosses(children, row);
  }
  else
  {
    children.CopyTo(m_Plan.OutputType, m_Buffer.data());
    const unsigned char * const wanted = m_Buffer.data() + m_Skipped * m_Bytes;
    this->CountLosses(children, wanted);
    if (isDense && m_IsLarge)
    {
      m_Streams[static_cast<std::size_t>(z) % Streams].Copy(wanted, m_Count * m_Bytes, row);
    }
    else
    {
      CopyElements(m_Bytes, wanted, static_cast<std::ptrdiff_t>(m_Bytes), m_Count, row, m_Step);
    }
  }
  m_Unreported += m_Count;
  if (m_Unreported >= ElementsPerReport)
  {
    this->Report();
  }
}

template <typename TReal>
void
RowWriter<TReal>::Report()
{
  const std::size_t elements = m_Unreported;
  m_Unreported = 0;
  m_Monitor.Completed(elements);
}

template <typename TReal>
void
RowWriter<TReal>::CountLosses(const ChildRow<TReal> & children, const void * const elements)
{
  // Values were lost only where an element is a limit of its type, or is 0 and may have been NaN.
  if (!m_CountsLosses || !MayHaveLost(m_Plan.OutputType, elements, m_Count, !IsInteger(m_Plan.InputType)))
  {
    return;
  }
  m_Reals.resize(children.GetSize());
  children.CopyTo(ElementTypeOf<TReal>(), m_Reals.data());
  const Losses losses = Subdivision::CountLosses(m_Plan.OutputType, m_Reals.data() + m_Skipped, m_Count);
  if (losses.NotANumber + losses.Clamped > 0)
  {
    m_Monitor.Lost(losses.NotANumber, losses.Clamped);
  }
}

template class RowWriter<float>;
template class RowWriter<double>;

} // namespace Subdivision
} // namespace itk
