// SPDX-License-Identifier: Apache-2.0
#include "memory/Layout.h"

#include <cstring>

namespace itk
{
namespace Subdivision
{
namespace
{

constexpr std::size_t CacheLine = 64;
constexpr std::size_t Page = 4096;

constexpr std::size_t
RoundUp(const std::size_t value, const std::size_t step)
{
  return (value + step - 1) / step * step;
}

template <typename T>
constexpr std::size_t Line = CacheLine / sizeof(T);

/** The same voxel of successive planes shall not compete for the same lines of the cache. */
template <typename T>
std::size_t
PlaneLength(const std::size_t values)
{
  return RoundUp(values, Page / sizeof(T)) + 5 * Line<T>;
}

} // namespace

template <typename T>
Layout<T>::Layout(const LayoutSize & size)
  : m_Height(size.Height)
  , m_HaloY(size.HaloY)
{
  // Loops begin and end at whole vectors, and so reach up to one of them further than the halo.
  const std::size_t vector = RoundUp(size.VectorBytes, CacheLine) / sizeof(T);
  m_HaloX = RoundUp(size.HaloX + 1, vector);
  m_RowLength = RoundUp(m_HaloX + size.Width + size.HaloX + vector, Line<T>);
  // Vectors may begin before the halo of the very first row.
  m_First = vector;
  m_Used = m_First;
}

template <typename T>
std::ptrdiff_t
Layout<T>::GetPitch() const
{
  return static_cast<std::ptrdiff_t>(m_RowLength);
}

template <typename T>
T *
Layout<T>::TakeRows(const std::size_t count)
{
  return this->Take(count * m_RowLength, m_HaloX);
}

template <typename T>
T *
Layout<T>::TakeChildRow()
{
  return this->Take(2 * m_RowLength, 0);
}

template <typename T>
T *
Layout<T>::TakePlane()
{
  return this->Take(PlaneLength<T>(m_RowLength * (m_Height + 2 * m_HaloY)), m_HaloY * m_RowLength + m_HaloX);
}

template <typename T>
T *
Layout<T>::TakePlaneWithoutHalo()
{
  return this->Take(PlaneLength<T>(m_RowLength * m_Height), m_HaloX);
}

template <typename T>
void
Layout<T>::Allocate()
{
  // The last row's last vector may reach beyond it.
  const std::size_t bytes = (m_Used + m_RowLength) * sizeof(T);
  m_Memory = AllocateOnHugePages(bytes);
  m_Begin = static_cast<T *>(m_Memory.get());
  std::memset(m_Memory.get(), 0, bytes);
  m_Used = m_First;
}

template <typename T>
T *
Layout<T>::Take(const std::size_t count, const std::size_t origin)
{
  T * const piece = m_Begin ? m_Begin + m_Used + origin : nullptr;
  m_Used += RoundUp(count, Line<T>);
  return piece;
}

template class Layout<float>;
template class Layout<double>;

} // namespace Subdivision
} // namespace itk
