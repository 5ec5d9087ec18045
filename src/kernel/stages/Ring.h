// SPDX-License-Identifier: Apache-2.0
#ifndef Ring_h
#define Ring_h

#include "memory/Layout.h"

#include <cassert>
#include <cstddef>
#include <cstdint>

namespace itk
{
namespace Subdivision
{

/** \brief The last few planes of a tile, or rows of a plane, by their own numbers: entry i takes the place of entry
 * i - VLength.
 *
 * Every place stands twice in the table, so that a stencil is one look-up and consecutive pointers. A debug build knows
 * which entry stands in a place, and asserts that what is read is what was meant. */
template <typename T, int VLength>
class Ring
{
public:
  /** Memory for each entry: a row, or a plane with or without the rows before and after it. */
  void
  AllocateRows(Layout<T> & layout)
  {
    this->Fill([&layout] { return layout.TakeRows(); });
  }
  void
  AllocatePlanes(Layout<T> & layout)
  {
    this->Fill([&layout] { return layout.TakePlane(); });
  }
  void
  AllocatePlanesWithoutHalo(Layout<T> & layout)
  {
    this->Fill([&layout] { return layout.TakePlaneWithoutHalo(); });
  }

  /** The place of an entry that is to be written. */
  T *
  Begin(const std::ptrdiff_t number)
  {
#ifndef NDEBUG
    m_Numbers[Place(number)] = number;
#endif
    return m_Entries[Place(number)];
  }

  /** An entry that was written. */
  T *
  operator[](const std::ptrdiff_t number) const
  {
    return *this->From(number, 1);
  }

  /** Consecutive entries that were written. */
  T * const *
  From(const std::ptrdiff_t first, const int count) const
  {
#ifndef NDEBUG
    for (std::ptrdiff_t number = first; number < first + count; ++number)
    {
      assert(m_Numbers[Place(number)] == number);
    }
#endif
    (void)count;
    return m_Entries + Place(first);
  }

  /** The place of an entry that may not have been written yet, where what is made of it is of no use either. */
  T * const *
  FromAny(const std::ptrdiff_t first) const
  {
    return m_Entries + Place(first);
  }

private:
  template <typename TTake>
  void
  Fill(const TTake & take)
  {
    for (int i = 0; i < VLength; ++i)
    {
      m_Entries[i] = take();
      m_Entries[i + VLength] = m_Entries[i];
    }
  }

  /** Numbers may be negative: rows before a tile, planes before the first one. */
  static std::size_t
  Place(const std::ptrdiff_t number)
  {
    assert(number >= -64 * VLength);
    return static_cast<std::uint32_t>(number + 64 * VLength) % static_cast<std::uint32_t>(VLength);
  }

  T * m_Entries[2 * VLength];
#ifndef NDEBUG
  std::ptrdiff_t m_Numbers[VLength]{};
#endif
};

/** The part of a plane that a sweep computes in. */
struct Shape
{
  std::ptrdiff_t Width;
  std::ptrdiff_t Height;
  /** Values from a row to the next one. */
  std::ptrdiff_t Pitch;
};

/** Planes whose children are best computed together, since they share most of what they read. */
inline constexpr int PlanesPerStep = 6;

} // namespace Subdivision
} // namespace itk

#endif
