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
    , m_Largest(image->GetLargestPossibleRegion())
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
  ReadRow(IndexType first, const SizeValueType count, const unsigned int component, TReal * const values) const
  {
    if (!this->IsNeeded(first))
    {
      std::fill_n(values, count, TReal{ 0 });
      return;
    }
    const IndexValueType begin = first[m_LaneAxis];
    const IndexValueType end = begin + static_cast<IndexValueType>(count);
    const Interval       needed = Intersect({ begin, end }, LaneInterval(m_Needed));
    std::fill_n(values, needed.Begin - begin, TReal{ 0 });
    std::fill(values + (needed.End - begin), values + count, TReal{ 0 });

    IndexType inside = first;
    if (!this->MapOtherAxes(inside))
    {
      this->ReadOutside(first, needed, component, values - begin);
      return;
    }
    const Interval image = Intersect(needed, LaneInterval(m_Largest));
    inside[m_LaneAxis] = image.Begin;
    const ComponentType * const pixels = this->ComponentsAt(inside) + component;
    this->Convert(pixels, image.End - image.Begin, values + (image.Begin - begin));
    const auto readEdge = [&](const Interval & edge) {
      if (!m_MapIndex)
      {
        this->ReadOutside(first, edge, component, values - begin);
        return;
      }
      for (IndexValueType i = edge.Begin; i < edge.End; ++i)
      {
        values[i - begin] = static_cast<TReal>(pixels[(this->MapIndex(i, m_LaneAxis) - image.Begin) * m_Stride]);
      }
    };
    readEdge({ needed.Begin, image.Begin });
    readEdge({ image.End, needed.End });
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
    return { std::max(a.Begin, b.Begin), std::min(a.End, b.End) };
  }

  Interval
  LaneInterval(const RegionType & region) const
  {
    const IndexValueType begin = region.GetIndex(m_LaneAxis);
    return { begin, begin + static_cast<IndexValueType>(region.GetSize(m_LaneAxis)) };
  }

  bool
  IsNeeded(IndexType index) const
  {
    index[m_LaneAxis] = m_Needed.GetIndex(m_LaneAxis);
    return m_Needed.IsInside(index);
  }

  IndexValueType
  MapIndex(const IndexValueType i, const unsigned int axis) const
  {
    const IndexValueType start = m_Largest.GetIndex(axis);
    return start + m_MapIndex(i - start, static_cast<IndexValueType>(m_Largest.GetSize(axis)));
  }

  /** Maps the row into the image. Returns false if it lies outside and the boundary condition is none that maps. */
  bool
  MapOtherAxes(IndexType & index) const
  {
    for (unsigned int axis = 0; axis < Dimension; ++axis)
    {
      const IndexValueType start = m_Largest.GetIndex(axis);
      const bool           isInside =
        index[axis] >= start && index[axis] < start + static_cast<IndexValueType>(m_Largest.GetSize(axis));
      if (axis == m_LaneAxis || isInside)
      {
        continue;
      }
      if (!m_MapIndex)
      {
        return false;
      }
      index[axis] = this->MapIndex(index[axis], axis);
    }
    return true;
  }

  /** Asks the boundary condition, pixel by pixel. */
  void
  ReadOutside(IndexType index, const Interval & interval, const unsigned int component, TReal * const values) const
  {
    using PixelType = typename TImage::PixelType;
    for (IndexValueType i = interval.Begin; i < interval.End; ++i)
    {
      index[m_LaneAxis] = i;
      const PixelType pixel = m_BoundaryCondition->GetPixel(index, m_Image);
      values[i] = static_cast<TReal>(DefaultConvertPixelTraits<PixelType>::GetNthComponent(component, pixel));
    }
  }

  const ComponentType *
  ComponentsAt(const IndexType & index) const
  {
    const auto * const components = reinterpret_cast<const ComponentType *>(m_Image->GetBufferPointer());
    return components + m_Image->ComputeOffset(index) * m_Components;
  }

  void
  Convert(const ComponentType * const pixels, const IndexValueType count, TReal * const values) const
  {
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

  const TImage *                m_Image;
  const BoundaryConditionType * m_BoundaryCondition;
  unsigned int                  m_LaneAxis;
  RegionType                    m_Needed;
  RegionType                    m_Largest;
  OffsetValueType               m_Components;
  OffsetValueType               m_Stride;

  /** Maps an index into [0, size), for boundary conditions that do nothing but that; null for others. */
  IndexValueType (*m_MapIndex)(IndexValueType index, IndexValueType size){ nullptr };
};

} // namespace itk

#endif
