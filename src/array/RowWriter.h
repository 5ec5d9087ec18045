// SPDX-License-Identifier: Apache-2.0
#ifndef RowWriter_h
#define RowWriter_h

#include "NonOscillatorySubdivision/Kernel.h"
#include "array/RunPlan.h"
#include "memory/NonTemporalWriter.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{
namespace Subdivision
{

/** \brief Scatters the rows of children of a tile into an array, as its elements need it. */
template <typename TReal>
class RowWriter final : public RowSink<TReal>
{
public:
  /** \param tile some positions along each axis of the plan
   * \param monitor is told of what is written
   * \param buffer room for a row, which grows as needed */
  RowWriter(const RunPlan &              plan,
            const TileAxes &             axes,
            const Box &                  tile,
            TileMonitor &                monitor,
            std::vector<unsigned char> & buffer);

  /** Chooses the position along each axis that is not one of the tile's; the others are ignored. */
  void
  SetImage(const std::vector<std::int64_t> & position);

  void
  WriteRow(std::ptrdiff_t y, std::ptrdiff_t z, const ChildRow<TReal> & children) override;

  /** Tells the monitor of what was written since it was last told. To be called at the end. */
  void
  Report();

private:
  /** Threads that tell a monitor of every row would wait for each other. */
  static constexpr std::size_t ElementsPerReport = std::size_t{ 1 } << 16;

  /** Outputs larger than the last-level cache of common processors, in bytes, are written past it. */
  static constexpr std::uint64_t CacheSize = std::uint64_t{ 16 } << 20;

  /** So many planes of children come in turns, whose rows follow one another. */
  static constexpr std::size_t Streams = 12;

  /** The outputs along y or z; one alone where the tile lacks the axis. */
  struct Line
  {
    /** The output that is the first child of the tile; may be negative. */
    std::int64_t   First{ 0 };
    std::int64_t   Outputs{ 1 };
    std::ptrdiff_t Step{ 0 };

    bool
    Has(const std::int64_t child) const
    {
      return First + child >= 0 && First + child < Outputs;
    }

    std::ptrdiff_t
    GetOffset(const std::int64_t child) const
    {
      return (First + child) * Step;
    }
  };

  /** Children of the tile along an axis, counted from the first output. */
  Interval
  GetChildren(std::size_t axis) const;

  Line
  GetLine(std::size_t axis) const;

  /** Tells the monitor what the elements of a row could not hold. */
  void
  CountLosses(const ChildRow<TReal> & children, const void * elements);

  const RunPlan & m_Plan;
  TileAxes        m_Axes;
  const Box &     m_Tile;
  Line            m_Y;
  Line            m_Z;
  TileMonitor &   m_Monitor;
  bool            m_CountsLosses;
  std::size_t     m_Unreported{ 0 };

  /** Bytes of an element, and from one to the next of a row. */
  std::size_t    m_Bytes;
  std::ptrdiff_t m_Step;

  /** The children of a row that the output has: how many come before them, and how many they are. */
  std::size_t m_Skipped;
  std::size_t m_Count;

  /** Whether the output is too large for who reads it to find much of it in the cache. */
  bool m_IsLarge;

  /** The first child that a row writes, and output 0 of the other axes of the tile. */
  unsigned char * m_Image{ nullptr };

  std::vector<unsigned char> &           m_Buffer;
  std::vector<TReal>                     m_Reals;
  std::array<NonTemporalWriter, Streams> m_Streams;
};

extern template class RowWriter<float>;
extern template class RowWriter<double>;

} // namespace Subdivision
} // namespace itk

#endif
