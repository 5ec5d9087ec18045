// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionTileAxes_h
#define itkSubdivisionTileAxes_h

#include "itkIntTypes.h"

#include <limits>
#include <vector>

namespace itk
{

/** \class SubdivisionTileAxes
 *
 * \brief Which axes of an image are the lanes, the rows and the sweep of its tiles (see SubdivisionKernel).
 *
 * Along the other axes every position is an image of its own.
 *
 * \ingroup NonOscillatorySubdivision
 */
class SubdivisionTileAxes
{
public:
  /** \param subdivided the subdivided axes, in order; three at most. Without any, tiles are rows along the first axis.
   */
  explicit SubdivisionTileAxes(const std::vector<unsigned int> & subdivided)
    : m_Number(static_cast<unsigned int>(subdivided.size()))
    , m_Lanes(subdivided.empty() ? 0 : subdivided.front())
    , m_Rows(m_Number > 2 ? subdivided[1] : m_Lanes)
    , m_Sweep(m_Number > 1 ? subdivided.back() : m_Lanes)
  {}

  /** The number of subdivided axes. */
  unsigned int
  GetNumber() const
  {
    return m_Number;
  }

  unsigned int
  GetLanes() const
  {
    return m_Lanes;
  }

  bool
  HasRows() const
  {
    return m_Number > 2;
  }

  /** Only if there are rows. */
  unsigned int
  GetRows() const
  {
    return m_Rows;
  }

  bool
  HasSweep() const
  {
    return m_Number > 1;
  }

  /** Only if there is a sweep. */
  unsigned int
  GetSweep() const
  {
    return m_Sweep;
  }

  /** Whether tiles extend along an axis. */
  bool
  Has(const unsigned int axis) const
  {
    return axis == m_Lanes || axis == m_Rows || axis == m_Sweep;
  }

  /** The first component of the pixel at \c position along the axes that are not those of the tiles, and at index 0,
   * which the buffer need not have, along those that are. */
  template <typename TComponent, typename TImage>
  TComponent *
  FindImage(TImage * const image, const typename TImage::IndexType & position) const
  {
    const auto &    start = image->GetBufferedRegion().GetIndex();
    OffsetValueType offset = 0;
    for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
    {
      offset += ((this->Has(axis) ? 0 : position[axis]) - start[axis]) * image->GetOffsetTable()[axis];
    }
    return reinterpret_cast<TComponent *>(image->GetBufferPointer()) +
           offset * static_cast<OffsetValueType>(image->GetNumberOfComponentsPerPixel());
  }

private:
  unsigned int m_Number;
  unsigned int m_Lanes;
  unsigned int m_Rows;
  unsigned int m_Sweep;
};

/** Where the pixels of a range of indices along an axis lie, in components from index 0, or one of two marks: the pixel
 * is of no use, or the boundary condition has to be asked for it. */
struct SubdivisionOffsets
{
  static constexpr OffsetValueType NotNeeded = std::numeric_limits<OffsetValueType>::max();
  static constexpr OffsetValueType AskBoundary = NotNeeded - 1;

  IndexValueType               First;
  std::vector<OffsetValueType> Values;

  OffsetValueType
  operator[](const IndexValueType index) const
  {
    return Values[static_cast<std::size_t>(index - First)];
  }
};

} // namespace itk

#endif
