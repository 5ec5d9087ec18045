// SPDX-License-Identifier: Apache-2.0
#ifndef Layout_h
#define Layout_h

#include "memory/HugePages.h"

#include <cstddef>

namespace itk
{
namespace Subdivision
{

/** What the rows and planes of a sweep must hold. */
struct LayoutSize
{
  /** Values of a row, without the halo. */
  std::size_t Width;
  /** Rows of a plane, without the halo. */
  std::size_t Height;
  /** Values that are reached before and after a row, and rows before and after a plane. */
  std::size_t HaloX;
  std::size_t HaloY;
  /** Loops over a row work in vectors of so many bytes, the last of which may reach that far beyond it. */
  std::size_t VectorBytes;
};

/** \brief Zeroed memory, aligned to cache lines, given out row by row and plane by plane.
 *
 * Whoever needs memory asks for it twice, in the same order: the first pass only counts and gives null pointers; after
 * Allocate(), the second pass gets the memory.
 *
 * Rows are given by their value 0, planes by value 0 of their row 0; row y begins y * GetPitch() values further on. Its
 * functions are compiled once, so that no copy of them that was made for a better processor is used by another. */
template <typename T>
class Layout
{
public:
  explicit Layout(const LayoutSize & size);

  /** Values from a row to the next one of its plane. */
  std::ptrdiff_t
  GetPitch() const;

  /** A row, or several that follow one another. */
  T *
  TakeRows(std::size_t count = 1);

  /** A row of children along x, two for each value, without a halo. */
  T *
  TakeChildRow();

  T *
  TakePlane();

  /** A plane without rows before and after it. */
  T *
  TakePlaneWithoutHalo();

  /** Ends the first pass.
   * \throw std::bad_alloc */
  void
  Allocate();

private:
  /** Memory for so many values, given by the one of them that is its origin. */
  T *
  Take(std::size_t count, std::size_t origin);

  std::size_t    m_HaloX;
  std::size_t    m_RowLength;
  std::size_t    m_Height;
  std::size_t    m_HaloY;
  std::size_t    m_First;
  HugePageMemory m_Memory;
  T *            m_Begin{ nullptr };
  std::size_t    m_Used{ 0 };
};

extern template class Layout<float>;
extern template class Layout<double>;

} // namespace Subdivision
} // namespace itk

#endif
