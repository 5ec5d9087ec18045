// SPDX-License-Identifier: Apache-2.0
#include "NonOscillatorySubdivision/Boundary.h"

#include "array/CheckedArithmetic.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace itk
{
namespace Subdivision
{
namespace
{

/** How many whole sizes lie below an index: 0 within [0, size), -1 before it. */
constexpr std::int64_t
GetRepetition(const std::int64_t index, const std::int64_t size)
{
  return index / size - (index % size < 0 ? 1 : 0);
}

/** The index within its repetition. */
constexpr std::int64_t
GetRemainder(const std::int64_t index, const std::int64_t size)
{
  return index % size + (index % size < 0 ? size : 0);
}

} // namespace

OutsideElements::~OutsideElements() = default;

Boundary::Boundary(const Kind kind)
  : m_Kind(kind)
{}

Boundary
Boundary::Nearest()
{
  return Boundary(Kind::Nearest);
}

Boundary
Boundary::Mirror()
{
  return Boundary(Kind::Mirror);
}

Boundary
Boundary::Periodic()
{
  return Boundary(Kind::Periodic);
}

Boundary
Boundary::Constant(std::vector<double> values)
{
  if (values.empty())
  {
    throw std::invalid_argument("a constant boundary needs a value");
  }
  Boundary boundary(Kind::Constant);
  boundary.m_Constants = std::move(values);
  return boundary;
}

Boundary
Boundary::Custom(std::shared_ptr<const OutsideElements> elements)
{
  if (!elements)
  {
    throw std::invalid_argument("a custom boundary needs somebody who is asked for the elements outside");
  }
  Boundary boundary(Kind::Custom);
  boundary.m_Elements = std::move(elements);
  return boundary;
}

bool
Boundary::MapsIndices() const
{
  return m_Kind != Kind::Constant && m_Kind != Kind::Custom;
}

std::int64_t
Boundary::MapIndex(const std::int64_t index, const std::int64_t size) const
{
  if (size < 1)
  {
    throw std::invalid_argument("no index of an empty array stands for one outside");
  }
  switch (m_Kind)
  {
    case Kind::Mirror:
    {
      // Every other repetition runs backwards.
      const std::int64_t remainder = GetRemainder(index, size);
      return GetRepetition(index, size) % 2 == 0 ? remainder : size - 1 - remainder;
    }
    case Kind::Periodic:
      return GetRemainder(index, size);
    default:
      return std::clamp<std::int64_t>(index, 0, size - 1);
  }
}

Interval
Boundary::GetRequest(const Interval & stencil, const Interval & whole) const
{
  if (stencil.Size == 0 || whole.Size == 0)
  {
    throw std::invalid_argument("nothing is requested for an empty stencil, or of an empty array");
  }
  const std::int64_t size = CheckedSigned(whole.Size);
  const std::int64_t first = CheckedSubtract(stencil.First, whole.First);
  const std::int64_t last = CheckedSubtract(GetLast(stencil), whole.First);
  const bool         isInside = first >= 0 && last < size;
  if (isInside)
  {
    return stencil;
  }
  const std::int64_t faces = GetRepetition(last, size) - GetRepetition(first, size);
  std::int64_t       lowest = std::min(this->MapIndex(first, size), this->MapIndex(last, size));
  std::int64_t       highest = std::max(this->MapIndex(first, size), this->MapIndex(last, size));
  if (m_Kind == Kind::Custom || (m_Kind == Kind::Periodic && faces > 0) || (m_Kind == Kind::Mirror && faces > 1))
  {
    return whole;
  }
  if (m_Kind == Kind::Mirror && faces == 1)
  {
    // Across a face lies the same end of the array, the first one at the faces 0, 2 size, ...
    (GetRepetition(last, size) % 2 == 0 ? lowest : highest) = GetRepetition(last, size) % 2 == 0 ? 0 : size - 1;
  }
  return { whole.First + lowest, static_cast<std::uint64_t>(highest - lowest + 1) };
}

const std::vector<double> &
Boundary::GetConstants() const
{
  return m_Constants;
}

const OutsideElements *
Boundary::GetElements() const
{
  return m_Elements.get();
}

} // namespace Subdivision
} // namespace itk
