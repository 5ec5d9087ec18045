// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionTileReader_h
#define itkSubdivisionTileReader_h

#include "itkMirrorBoundaryCondition.h"
#include "itkSubdivisionPixelTraits.h"

#include "itkDefaultConvertPixelTraits.h"
#include "itkPeriodicBoundaryCondition.h"
#include "itkZeroFluxNeumannBoundaryCondition.h"

#include <algorithm>

namespace itk
{

/** \class SubdivisionTileReader
 *
 * \brief Gathers rows of pixels, inside and outside an image, as rows of real values.
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

  static constexpr unsigned int Dimension = TImage::ImageDimension;

  /**
   * \param image the image, whose buffer holds what \c needed asks of it
   * \param boundaryCondition supplies the pixels outside the image
   * \param laneAxis the axis that rows run along
   * \param needed the pixels that matter; all others are read as 0
   */
  SubdivisionTileReader(const TImage *                image,
                        const BoundaryConditionType * boundaryCondition,
                        const unsigned int            laneAxis,
                        const RegionType &            needed)
    : m_Image(image)
    , m_BoundaryCondition(boundaryCondition)
    , m_LaneAxis(laneAxis)
    , m_Needed(needed)
    , m_NeededLanes(LaneInterval(needed))
    , m_ImageLanes(LaneInterval(image->GetLargestPossibleRegion()))
    , m_Components(image->GetNumberOfComponentsPerPixel())
    , m_Stride(m_Components * image->GetOffsetTable()[laneAxis])
  {
    if (dynamic_cast<const ZeroFluxNeumannBoundaryCondition<TImage, TImage> *>(boundaryCondition))
    {
      m_MapIndex = [](IndexValueType i, IndexValueType size) { return i < 0 ? 0 : std::min(i, size - 1); };
    }
    else if (dynamic_cast<const MirrorBoundaryCondition<TImage, TImage> *>(boundaryCondition))
    {
      m_MapIndex = &MirrorIndex;
    }
    else if (dynamic_cast<const PeriodicBoundaryCondition<TImage, TImage> *>(boundaryCondition))
    {
      m_MapIndex = [](IndexValueType i, IndexValueType size) { return (i % size + size) % size; };
    }
  }

  /** Reads one component of \c count pixels along the lane axis. */
  void
  ReadRow(const IndexType & first, const SizeValueType count, const unsigned int component, TReal * const values) const
  {
    const IndexValueType begin = first[m_LaneAxis];
    const Interval       row{ begin, begin + static_cast<IndexValueType>(count) };
    const Interval       needed = this->IsNeeded(first) ? Intersect(row, m_NeededLanes) : Interval{ begin, begin };
    std::fill_n(values, needed.Begin - row.Begin, TReal{ 0 });
    std::fill_n(values + (needed.End - begin), row.End - needed.End, TReal{ 0 });

    const Interval              inside = Intersect(needed, m_ImageLanes);
    const ComponentType * const pixels = this->FindRow(first);
    if (!pixels || inside.Begin >= inside.End)
    {
      this->ReadOutside(first, needed, component, values - begin);
      return;
    }
    this->ReadInside(pixels + component, inside, values - begin);
    this->ReadOutside(first, { needed.Begin, inside.Begin }, component, values - begin);
    this->ReadOutside(first, { inside.End, needed.End }, component, values - begin);
  }

  /** Asks for the memory of a row that will be read soon. */
  void
  PrefetchRow(const IndexType & first, const SizeValueType count) const
  {
    const IndexValueType begin = first[m_LaneAxis];
    const Interval       row{ begin, begin + static_cast<IndexValueType>(count) };
    const Interval       inside = Intersect(Intersect(row, m_NeededLanes), m_ImageLanes);
    if (const ComponentType * const pixels = this->IsNeeded(first) ? this->FindRow(first) : nullptr)
    {
      SubdivisionPrefetch(pixels + inside.Begin * m_Stride, pixels + inside.End * m_Stride);
    }
  }

private:
  struct Interval
  {
    IndexValueType Begin;
    IndexValueType End;
  };

  static Interval
  Intersect(const Interval & a, const Interval & b)
  {
    const IndexValueType begin = std::max(a.Begin, b.Begin);
    return { begin, std::max(begin, std::min(a.End, b.End)) };
  }

  Interval
  LaneInterval(const RegionType & region) const
  {
    const IndexValueType begin = region.GetIndex(m_LaneAxis);
    return { begin, begin + static_cast<IndexValueType>(region.GetSize(m_LaneAxis)) };
  }

  /** Whether any pixel of the row is. */
  bool
  IsNeeded(const IndexType & index) const
  {
    for (unsigned int axis = 0; axis < Dimension; ++axis)
    {
      const IndexValueType offset = index[axis] - m_Needed.GetIndex(axis);
      if (axis != m_LaneAxis && (offset < 0 || offset >= static_cast<IndexValueType>(m_Needed.GetSize(axis))))
      {
        return false;
      }
    }
    return true;
  }

  /** An index along an axis, outside the image, as the boundary condition maps it into it. */
  IndexValueType
  MapIndex(const IndexValueType i, const unsigned int axis) const
  {
    const IndexValueType start = m_Image->GetLargestPossibleRegion().GetIndex(axis);
    const auto           size = static_cast<IndexValueType>(m_Image->GetLargestPossibleRegion().GetSize(axis));
    return start + m_MapIndex(i - start, size);
  }

  /** Where index 0 along the lane axis lies, or would lie, of a row or of the one that it is mapped to; null if it lies
   * outside the image and is not mapped. */
  const ComponentType *
  FindRow(const IndexType & index) const
  {
    const RegionType & largest = m_Image->GetLargestPossibleRegion();
    const RegionType & buffered = m_Image->GetBufferedRegion();
    OffsetValueType    offset = -buffered.GetIndex(m_LaneAxis) * m_Image->GetOffsetTable()[m_LaneAxis];
    for (unsigned int axis = 0; axis < Dimension; ++axis)
    {
      if (axis == m_LaneAxis)
      {
        continue;
      }
      IndexValueType       i = index[axis];
      const IndexValueType start = largest.GetIndex(axis);
      if (i < start || i >= start + static_cast<IndexValueType>(largest.GetSize(axis)))
      {
        if (!m_MapIndex)
        {
          return nullptr;
        }
        i = this->MapIndex(i, axis);
      }
      offset += (i - buffered.GetIndex(axis)) * m_Image->GetOffsetTable()[axis];
    }
    return reinterpret_cast<const ComponentType *>(m_Image->GetBufferPointer()) + offset * m_Components;
  }

  /** Reads pixels of a row by their index along the lane axis. */
  void
  ReadInside(const ComponentType * const pixels, const Interval & interval, TReal * const values) const
  {
    using VectorPixelType = SubdivisionVectorPixelType<ComponentType>;
    if constexpr (std::is_same<TReal, float>::value && !std::is_void<VectorPixelType>::value)
    {
      if (m_Stride == 1)
      {
        ConvertRow(reinterpret_cast<const VectorPixelType *>(pixels + interval.Begin),
                   static_cast<std::size_t>(interval.End - interval.Begin),
                   values + interval.Begin);
        return;
      }
    }
    for (IndexValueType i = interval.Begin; i < interval.End; ++i)
    {
      values[i] = static_cast<TReal>(pixels[i * m_Stride]);
    }
  }

  /** Reads pixels that the boundary condition supplies: maps them, or asks it for each. */
  void
  ReadOutside(const IndexType &    first,
              const Interval &     interval,
              const unsigned int   component,
              TReal * const        values) const
  {
    if (interval.Begin >= interval.End)
    {
      return;
    }
    if (m_MapIndex)
    {
      const ComponentType * const pixels = this->FindRow(first) + component;
      for (IndexValueType i = interval.Begin; i < interval.End; ++i)
      {
        values[i] = static_cast<TReal>(pixels[this->MapIndex(i, m_LaneAxis) * m_Stride]);
      }
      return;
    }
    using PixelType = typename TImage::PixelType;
    IndexType index = first;
    for (IndexValueType i = interval.Begin; i < interval.End; ++i)
    {
      index[m_LaneAxis] = i;
      const PixelType pixel = m_BoundaryCondition->GetPixel(index, m_Image);
      values[i] = static_cast<TReal>(DefaultConvertPixelTraits<PixelType>::GetNthComponent(component, pixel));
    }
  }

  const TImage *                m_Image;
  const BoundaryConditionType * m_BoundaryCondition;
  unsigned int                  m_LaneAxis;
  RegionType                    m_Needed;
  Interval                      m_NeededLanes;
  Interval                      m_ImageLanes;
  OffsetValueType               m_Components;
  OffsetValueType               m_Stride;

  /** Maps an index into [0, size), for boundary conditions that do nothing but that; null for others. */
  IndexValueType (*m_MapIndex)(IndexValueType index, IndexValueType size){ nullptr };
};

} // namespace itk

#endif
