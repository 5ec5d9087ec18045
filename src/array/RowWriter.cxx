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
  , m_Monitor(monitor)
  , m_CountsLosses(monitor.CountsLosses() && IsInteger(plan.OutputType))
  , m_IsLarge(GetBytes(plan) > CacheSize)
  , m_Buffer(buffer)
{
  const Interval     children = this->GetChildren(axes.X);
  const std::int64_t begin = std::max<std::int64_t>(children.First, 0);
  const std::int64_t end = std::min(children.First + static_cast<std::int64_t>(children.Size),
                                    static_cast<std::int64_t>(plan.Axes[axes.X].Outputs));
  m_Skipped = static_cast<std::size_t>(begin - children.First);
  m_Count = static_cast<std::size_t>(end - begin);
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
bool
RowWriter<TReal>::MoveTo(const std::size_t axis, const std::ptrdiff_t child, unsigned char *& row) const
{
  if (axis == TileAxes::None)
  {
    return true;
  }
  const std::int64_t output = this->GetChildren(axis).First + child;
  if (output < 0 || output >= static_cast<std::int64_t>(m_Plan.Axes[axis].Outputs))
  {
    return false;
  }
  row += output * m_Plan.Axes[axis].OutputStep;
  return true;
}

template <typename TReal>
void
RowWriter<TReal>::WriteRow(const std::ptrdiff_t y, const std::ptrdiff_t z, const ChildRow<TReal> & children)
{
  unsigned char * row = m_Image;
  if (!this->MoveTo(m_Axes.Y, y, row) || !this->MoveTo(m_Axes.Z, z, row))
  {
    return;
  }
  const std::size_t    bytes = SizeOf(m_Plan.OutputType);
  const std::ptrdiff_t step = m_Plan.Axes[m_Axes.X].OutputStep;
  const bool           isDense = step == static_cast<std::ptrdiff_t>(bytes);
  if (isDense && !m_IsLarge && m_Count == children.GetSize())
  {
    children.CopyTo(m_Plan.OutputType, row);
    this->CountLosses(children, row);
  }
  else
  {
    m_Buffer.resize(std::max(m_Buffer.size(), children.GetSize() * bytes));
    children.CopyTo(m_Plan.OutputType, m_Buffer.data());
    const unsigned char * const wanted = m_Buffer.data() + m_Skipped * bytes;
    this->CountLosses(children, wanted);
    if (isDense && m_IsLarge)
    {
      m_Streams[static_cast<std::size_t>(z) % Streams].Copy(wanted, m_Count * bytes, row);
    }
    else
    {
      CopyElements(bytes, wanted, static_cast<std::ptrdiff_t>(bytes), m_Count, row, step);
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
