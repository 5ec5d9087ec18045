// SPDX-License-Identifier: Apache-2.0
#include "array/RowReader.h"

#include "array/Elements.h"

#include <algorithm>

namespace itk
{
namespace Subdivision
{

template <typename TReal>
RowReader<TReal>::RowReader(const RunPlan & plan, const TileAxes & axes, const Box & tile)
  : m_Plan(plan)
  , m_Axes(axes)
  , m_Tile(tile)
  , m_Row(this->WithHalo(axes.X))
  , m_Index(plan.ArrayAxes)
{
  const RunAxis & x = plan.Axes[axes.X];
  const auto end = [](const Interval & interval) { return interval.First + static_cast<std::int64_t>(interval.Size); };
  m_Inside.Begin = std::max({ m_Row.Begin, x.Stencil.First, x.Whole.First });
  m_Inside.End = std::min({ m_Row.End, end(x.Stencil), end(x.Whole) });
  m_XBefore = this->FindEndOffsets({ m_Row.Begin, m_Inside.Begin });
  m_XAfter = this->FindEndOffsets({ m_Inside.End, m_Row.End });
  if (axes.HasY())
  {
    m_YOffsets = this->FindOffsets(axes.Y, this->WithHalo(axes.Y));
  }
  if (axes.HasZ())
  {
    m_ZOffsets = this->FindOffsets(axes.Z, this->WithHalo(axes.Z));
  }
}

template <typename TReal>
auto
RowReader<TReal>::WithHalo(const std::size_t axis) const -> Range
{
  const std::int64_t halo = m_Plan.Axes[axis].IsSubdivided ? m_Plan.Radius : 0;
  const std::int64_t begin = m_Tile[axis].First;
  return { begin - halo, begin + static_cast<std::int64_t>(m_Tile[axis].Size) + halo };
}

template <typename TReal>
std::ptrdiff_t
RowReader<TReal>::FindOffset(const std::size_t number, const std::int64_t position) const
{
  const RunAxis & axis = m_Plan.Axes[number];
  const auto      isIn = [position](const Interval & interval) {
    return position >= interval.First && position - interval.First < static_cast<std::int64_t>(interval.Size);
  };
  if (!isIn(axis.Stencil))
  {
    return NotNeeded;
  }
  if (isIn(axis.Whole))
  {
    return position * axis.InputStep;
  }
  if (m_Plan.Boundary.MapsIndices())
  {
    const auto         size = static_cast<std::int64_t>(axis.Whole.Size);
    const std::int64_t index = m_Plan.Boundary.MapIndex(position - axis.Whole.First, size);
    return (axis.Whole.First + index) * axis.InputStep;
  }
  return AskBoundary;
}

template <typename TReal>
auto
RowReader<TReal>::FindOffsets(const std::size_t axis, const Range & range) const -> Offsets
{
  Offsets offsets{ range, {} };
  offsets.Values.reserve(static_cast<std::size_t>(range.End - range.Begin));
  for (std::int64_t position = range.Begin; position < range.End; ++position)
  {
    offsets.Values.push_back(this->FindOffset(axis, position));
  }
  return offsets;
}

template <typename TReal>
auto
RowReader<TReal>::FindEndOffsets(const Range & range) const -> Offsets
{
  Offsets offsets = this->FindOffsets(m_Axes.X, range);
  if (m_Plan.Boundary.MapsIndices())
  {
    std::replace(offsets.Values.begin(),
                 offsets.Values.end(),
                 NotNeeded,
                 static_cast<std::ptrdiff_t>(m_Inside.Begin * m_Plan.Axes[m_Axes.X].InputStep));
  }
  return offsets;
}

template <typename TReal>
void
RowReader<TReal>::SetImage(const std::vector<std::int64_t> & position)
{
  m_Image = m_Plan.Input;
  for (std::size_t axis = 0; axis < position.size(); ++axis)
  {
    if (!m_Axes.Has(axis))
    {
      m_Image += position[axis] * m_Plan.Axes[axis].InputStep;
      this->SetIndex(axis, position[axis]);
    }
  }
}

template <typename TReal>
void
RowReader<TReal>::ReadRow(const std::ptrdiff_t y, const std::ptrdiff_t z, TReal * const values)
{
  const std::int64_t   yPosition = m_Axes.HasY() ? m_Tile[m_Axes.Y].First + y : 0;
  const std::int64_t   zPosition = m_Axes.HasZ() ? m_Tile[m_Axes.Z].First + z : 0;
  const std::ptrdiff_t yOffset = m_Axes.HasY() ? m_YOffsets[yPosition] : 0;
  const std::ptrdiff_t zOffset = m_Axes.HasZ() ? m_ZOffsets[zPosition] : 0;
  if (yOffset == NotNeeded || zOffset == NotNeeded)
  {
    std::fill_n(values, m_Row.End - m_Row.Begin, TReal{ 0 });
    return;
  }
  if (!m_Plan.Boundary.MapsIndices())
  {
    this->SetIndex(m_Axes.Y, yPosition);
    this->SetIndex(m_Axes.Z, zPosition);
  }
  if (yOffset == AskBoundary || zOffset == AskBoundary)
  {
    this->ReadRowOutside(values);
    return;
  }
  const unsigned char * const row = m_Image + yOffset + zOffset;
  this->ReadInside(row, values);
  this->ReadEnd(row, m_XBefore, values);
  this->ReadEnd(row, m_XAfter, values);
}

template <typename TReal>
void
RowReader<TReal>::ReadInside(const unsigned char * const row, TReal * const values) const
{
  const std::ptrdiff_t        step = m_Plan.Axes[m_Axes.X].InputStep;
  const unsigned char * const elements = row + m_Inside.Begin * step;
  const auto                  count = static_cast<std::size_t>(m_Inside.End - m_Inside.Begin);
  TReal * const               inside = values + (m_Inside.Begin - m_Row.Begin);
  if (step == static_cast<std::ptrdiff_t>(SizeOf(m_Plan.InputType)))
  {
    m_Plan.Target->Widen(m_Plan.InputType, elements, count, inside);
  }
  else
  {
    Gather(m_Plan.InputType, elements, step, count, inside);
  }
}

template <typename TReal>
void
RowReader<TReal>::ReadEnd(const unsigned char * const row, const Offsets & end, TReal * const values)
{
  TReal * const outside = values + (end.Positions.Begin - m_Row.Begin);
  if (m_Plan.Boundary.MapsIndices())
  {
    GatherAt(m_Plan.InputType, row, end.Values, outside);
    return;
  }
  for (std::int64_t x = end.Positions.Begin; x < end.Positions.End; ++x)
  {
    outside[x - end.Positions.Begin] = end[x] == AskBoundary ? this->GetOutsideValue(x) : TReal{ 0 };
  }
}

template <typename TReal>
void
RowReader<TReal>::ReadRowOutside(TReal * const values)
{
  for (std::int64_t x = m_Row.Begin; x < m_Row.End; ++x)
  {
    const Interval & stencil = m_Plan.Axes[m_Axes.X].Stencil;
    const bool       isNeeded = x >= stencil.First && x - stencil.First < static_cast<std::int64_t>(stencil.Size);
    values[x - m_Row.Begin] = isNeeded ? this->GetOutsideValue(x) : TReal{ 0 };
  }
}

template <typename TReal>
TReal
RowReader<TReal>::GetOutsideValue(const std::int64_t x)
{
  const std::vector<double> & constants = m_Plan.Boundary.GetConstants();
  if (constants.size() == 1)
  {
    return static_cast<TReal>(constants.front());
  }
  this->SetIndex(m_Axes.X, x);
  return static_cast<TReal>(constants.empty() ? m_Plan.Boundary.GetElements()->GetElement(m_Index.data())
                                              : constants[static_cast<std::size_t>(m_Index[0] - m_Plan.FirstConstant)]);
}

template <typename TReal>
void
RowReader<TReal>::SetIndex(const std::size_t axis, std::int64_t position)
{
  if (axis == TileAxes::None)
  {
    return;
  }
  const std::vector<RunAxis::Part> & parts = m_Plan.Axes[axis].Parts;
  if (parts.size() == 1)
  {
    m_Index[parts.front().ArrayAxis] = parts.front().First + position;
    return;
  }
  for (const RunAxis::Part & part : parts)
  {
    const auto size = static_cast<std::int64_t>(part.Size);
    m_Index[part.ArrayAxis] = part.First + position % size;
    position /= size;
  }
}

template class RowReader<float>;
template class RowReader<double>;

} // namespace Subdivision
} // namespace itk
