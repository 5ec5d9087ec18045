// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionTileReader_h
#define itkSubdivisionTileReader_h

#include "itkMirrorBoundaryCondition.h"
#include "itkSubdivisionPixelTraits.h"
#include "itkSubdivisionTileAxes.h"

#include "itkDefaultConvertPixelTraits.h"
#include "itkPeriodicBoundaryCondition.h"
#include "itkZeroFluxNeumannBoundaryCondition.h"

#include <algorithm>

namespace itk
{

/** \class SubdivisionTileReader
 *
 * \brief Gathers the rows of a tile and of its halo, inside and outside an image, as rows of real values.
 *
 * What is to be read along each axis is found out once for a tile.
 *
 * \ingroup NonOscillatorySubdivision
 */
template <typename TImage, typename TReal>
class SubdivisionTileReader
{
public:
  using RegionType = typename TImage::RegionType;
  using IndexType = typename TImage::IndexType;
  using ComponentType = SubdivisionComponentType<TImage>;
  using BoundaryConditionType = ImageBoundaryCondition<TImage, TImage>;

  /**
   * \param image the image, whose buffer holds what \c stencil asks of it
   * \param boundaryCondition supplies the pixels outside the image
   * \param axes the axes of the tile
   * \param tile the pixels of the tile, without its halo
   * \param halo the width of the halo along the axes of the tile
   * \param stencil the pixels that matter; others are read as 0
   */
  SubdivisionTileReader(const TImage *                image,
                        const BoundaryConditionType * boundaryCondition,
                        const SubdivisionTileAxes &   axes,
                        const RegionType &            tile,
                        const IndexValueType          halo,
                        const RegionType &            stencil)
    : m_Image(image)
    , m_BoundaryCondition(boundaryCondition)
    , m_Axes(axes)
    , m_Components(image->GetNumberOfComponentsPerPixel())
    , m_Stride(m_Components * image->GetOffsetTable()[axes.GetLanes()])
    , m_MapIndex(FindIndexMap(boundaryCondition))
    , m_Lanes(WithHalo(tile, axes.GetLanes(), halo))
    , m_LaneOffsets(this->FindOffsets(axes.GetLanes(), m_Lanes, stencil))
  {
    if (axes.HasRows())
    {
      m_RowOffsets = this->FindOffsets(axes.GetRows(), WithHalo(tile, axes.GetRows(), halo), stencil);
    }
    if (axes.HasSweep())
    {
      m_PlaneOffsets = this->FindOffsets(axes.GetSweep(), WithHalo(tile, axes.GetSweep(), halo), stencil);
    }
    const Interval needed = Intersect(m_Lanes, WithHalo(stencil, axes.GetLanes(), 0));
    m_Inside = Intersect(needed, WithHalo(image->GetLargestPossibleRegion(), axes.GetLanes(), 0));
  }

  /** Chooses the position along the axes that are not the tile's, and the component that is read. */
  void
  SetImage(const IndexType & position, const unsigned int component)
  {
    m_Position = position;
    m_Component = component;
    m_Pixels = m_Axes.template FindImage<const ComponentType>(m_Image, position) + component;
  }

  /** Reads a row and its halo into \c values. Row and plane are indices along their axes, if the tile has these. */
  void
  ReadRow(const IndexValueType row, const IndexValueType plane, TReal * const values) const
  {
    const OffsetValueType rowOffset = m_Axes.HasRows() ? m_RowOffsets[row] : 0;
    const OffsetValueType planeOffset = m_Axes.HasSweep() ? m_PlaneOffsets[plane] : 0;
    if (rowOffset == SubdivisionOffsets::NotNeeded || planeOffset == SubdivisionOffsets::NotNeeded)
    {
      std::fill_n(values, m_Lanes.End - m_Lanes.Begin, TReal{ 0 });
      return;
    }
    if (rowOffset == SubdivisionOffsets::AskBoundary || planeOffset == SubdivisionOffsets::AskBoundary)
    {
      this->ReadOutside(nullptr, m_Lanes, row, plane, values);
      return;
    }
    const ComponentType * const pixels = m_Pixels + rowOffset + planeOffset;
    this->ReadInside(pixels + m_Inside.Begin * m_Stride, values + (m_Inside.Begin - m_Lanes.Begin));
    this->ReadOutside(pixels, { m_Lanes.Begin, m_Inside.Begin }, row, plane, values);
    this->ReadOutside(pixels, { m_Inside.End, m_Lanes.End }, row, plane, values);
  }

private:
  /** Maps an index outside [0, size) into it. */
  using IndexMapType = IndexValueType (*)(IndexValueType index, IndexValueType size);

  struct Interval
  {
    IndexValueType Begin;
    IndexValueType End;
  };

  static Interval
  Intersect(const Interval & a, const Interval & b)
  {
    return { std::max(a.Begin, b.Begin), std::min(a.End, b.End) };
  }

  static Interval
  WithHalo(const RegionType & region, const unsigned int axis, const IndexValueType halo)
  {
    const IndexValueType begin = region.GetIndex(axis);
    return { begin - halo, begin + static_cast<IndexValueType>(region.GetSize(axis)) + halo };
  }

  /** What a boundary condition does to an index, if it does nothing but map indices; otherwise null. */
  static IndexMapType
  FindIndexMap(const BoundaryConditionType * const boundaryCondition)
  {
    if (dynamic_cast<const ZeroFluxNeumannBoundaryCondition<TImage, TImage> *>(boundaryCondition))
    {
      return [](IndexValueType i, IndexValueType size) { return i < 0 ? 0 : std::min(i, size - 1); };
    }
    if (dynamic_cast<const MirrorBoundaryCondition<TImage, TImage> *>(boundaryCondition))
    {
      return &MirrorIndex;
    }
    if (dynamic_cast<const PeriodicBoundaryCondition<TImage, TImage> *>(boundaryCondition))
    {
      return [](IndexValueType i, IndexValueType size) { return (i % size + size) % size; };
    }
    return nullptr;
  }

  SubdivisionOffsets
  FindOffsets(const unsigned int axis, const Interval & range, const RegionType & stencil) const
  {
    const Interval        image = WithHalo(m_Image->GetLargestPossibleRegion(), axis, 0);
    const Interval        needed = WithHalo(stencil, axis, 0);
    const OffsetValueType stride = m_Components * m_Image->GetOffsetTable()[axis];
    SubdivisionOffsets    offsets{ range.Begin, {} };
    for (IndexValueType i = range.Begin; i < range.End; ++i)
    {
      if (i < needed.Begin || i >= needed.End)
      {
        offsets.Values.push_back(SubdivisionOffsets::NotNeeded);
      }
      else if (i >= image.Begin && i < image.End)
      {
        offsets.Values.push_back(i * stride);
      }
      else if (m_MapIndex)
      {
        offsets.Values.push_back((image.Begin + m_MapIndex(i - image.Begin, image.End - image.Begin)) * stride);
      }
      else
      {
        offsets.Values.push_back(SubdivisionOffsets::AskBoundary);
      }
    }
    return offsets;
  }

  void
  ReadInside(const ComponentType * const pixels, TReal * const values) const
  {
    const IndexValueType count = m_Inside.End - m_Inside.Begin;
    using VectorPixelType = SubdivisionVectorPixelType<ComponentType>;
    if constexpr (std::is_same<TReal, float>::value && !std::is_void<VectorPixelType>::value)
    {
      if (m_Stride == 1)
      {
        ConvertRow(reinterpret_cast<const VectorPixelType *>(pixels), static_cast<std::size_t>(count), values);
        return;
      }
    }
    for (IndexValueType i = 0; i < count; ++i)
    {
      values[i] = static_cast<TReal>(pixels[i * m_Stride]);
    }
  }

  /** Reads pixel by pixel what is not needed, what is mapped into the row, whose pixels begin at \c pixels, and what
   * the boundary condition is to be asked for; without a row, it is asked for all that is needed. */
  void
  ReadOutside(const ComponentType * const pixels,
              const Interval &            interval,
              const IndexValueType        row,
              const IndexValueType        plane,
              TReal * const               values) const
  {
    for (IndexValueType i = interval.Begin; i < interval.End; ++i)
    {
      const OffsetValueType offset = m_LaneOffsets[i];
      TReal &               value = values[i - m_Lanes.Begin];
      if (offset == SubdivisionOffsets::NotNeeded)
      {
        value = TReal{ 0 };
      }
      else if (pixels && offset != SubdivisionOffsets::AskBoundary)
      {
        value = static_cast<TReal>(pixels[offset]);
      }
      else
      {
        value = this->AskBoundaryCondition(i, row, plane);
      }
    }
  }

  TReal
  AskBoundaryCondition(const IndexValueType lane, const IndexValueType row, const IndexValueType plane) const
  {
    IndexType index = m_Position;
    index[m_Axes.GetLanes()] = lane;
    if (m_Axes.HasRows())
    {
      index[m_Axes.GetRows()] = row;
    }
    if (m_Axes.HasSweep())
    {
      index[m_Axes.GetSweep()] = plane;
    }
    using PixelType = typename TImage::PixelType;
    const PixelType pixel = m_BoundaryCondition->GetPixel(index, m_Image);
    return static_cast<TReal>(DefaultConvertPixelTraits<PixelType>::GetNthComponent(m_Component, pixel));
  }

  const TImage *                m_Image;
  const BoundaryConditionType * m_BoundaryCondition;
  SubdivisionTileAxes           m_Axes;
  OffsetValueType               m_Components;
  OffsetValueType               m_Stride;
  IndexMapType                  m_MapIndex;

  /** The row with its halo, and the part of it that is needed and inside the image. */
  Interval m_Lanes;
  Interval m_Inside;

  SubdivisionOffsets m_LaneOffsets;
  SubdivisionOffsets m_RowOffsets;
  SubdivisionOffsets m_PlaneOffsets;

  IndexType             m_Position;
  unsigned int          m_Component{ 0 };
  const ComponentType * m_Pixels{ nullptr };
};

} // namespace itk

#endif
