// SPDX-License-Identifier: Apache-2.0
#ifndef RowReader_h
#define RowReader_h

#include "NonOscillatorySubdivision/Kernel.h"
#include "array/RunPlan.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{
namespace Subdivision
{

/** \brief Gathers the rows of a tile and of its halo, inside and outside an array, as real values.
 *
 * What is to be read along each axis is found out once for a tile. */
template <typename TReal>
class RowReader final : public RowSource<TReal>
{
public:
  /** \param tile some positions along each axis of the plan, without the halo */
  RowReader(const RunPlan & plan, const TileAxes & axes, const Box & tile);

  /** Chooses the position along each axis that is not one of the tile's; the others are ignored. */
  void
  SetImage(const std::vector<std::int64_t> & position);

  void
  ReadRow(std::ptrdiff_t y, std::ptrdiff_t z, TReal * values) override;

private:
  /** Positions from Begin up to, but not with, End. */
  struct Range
  {
    std::int64_t Begin;
    std::int64_t End;
  };

  /** What stands at some positions along an axis: offsets in bytes from position 0, or one of two marks. */
  struct Offsets
  {
    Range                       Positions{ 0, 0 };
    std::vector<std::ptrdiff_t> Values;

    std::ptrdiff_t
    operator[](const std::int64_t position) const
    {
      return Values[static_cast<std::size_t>(position - Positions.Begin)];
    }
  };

  /** The element is of no use. */
  static constexpr std::ptrdiff_t NotNeeded = std::numeric_limits<std::ptrdiff_t>::max();
  /** It lies outside and follows no rule of indices. */
  static constexpr std::ptrdiff_t AskBoundary = NotNeeded - 1;

  Range
  WithHalo(std::size_t axis) const;

  std::ptrdiff_t
  FindOffset(std::size_t axis, std::int64_t position) const;

  Offsets
  FindOffsets(std::size_t axis, const Range & range) const;

  /** The offsets beyond one end of the inside of a row. Where the boundary maps indices there are no marks: any element
   * does where none is needed. */
  Offsets
  FindEndOffsets(const Range & range) const;

  void
  ReadInside(const unsigned char * row, TReal * values) const;

  /** Reads what lies beyond one end of the inside of a row, whose position 0 is at \c row. */
  void
  ReadEnd(const unsigned char * row, const Offsets & end, TReal * values);

  /** Reads a row that lies outside. */
  void
  ReadRowOutside(TReal * values);

  /** The value that the boundary supplies at a position of the row that was chosen last. */
  TReal
  GetOutsideValue(std::int64_t x);

  /** Says which element is meant, for the boundary. */
  void
  SetIndex(std::size_t axis, std::int64_t position);

  const RunPlan & m_Plan;
  TileAxes        m_Axes;
  const Box &     m_Tile;

  /** The row with its halo, and the part of it that is needed and inside the array. */
  Range   m_Row;
  Range   m_Inside;
  Offsets m_XBefore;
  Offsets m_XAfter;
  Offsets m_YOffsets;
  Offsets m_ZOffsets;

  /** Position 0 of the tile's axes. */
  const unsigned char * m_Image{ nullptr };
  /** An index for each axis of the arrays. */
  std::vector<std::int64_t> m_Index;
};

extern template class RowReader<float>;
extern template class RowReader<double>;

} // namespace Subdivision
} // namespace itk

#endif
