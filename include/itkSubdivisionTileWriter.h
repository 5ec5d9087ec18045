// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionTileWriter_h
#define itkSubdivisionTileWriter_h

#include "itkSubdivisionMasks.h"
#include "itkSubdivisionPixelTraits.h"

#include <memory>

namespace itk
{

/** \class SubdivisionTileWriter
 *
 * \brief Scatters rows of children into an image, rounded and clamped as its pixels need it.
 *
 * \ingroup NonOscillatorySubdivision
 */
template <typename TImage, typename TReal>
class SubdivisionTileWriter
{
public:
  using RegionType = typename TImage::RegionType;
  using IndexType = typename TImage::IndexType;
  using ComponentType = SubdivisionComponentType<TImage>;
  using LanePair = typename SubdivisionKernel<TReal>::LanePair;

  /**
   * \param image the image
   * \param laneAxis the axis that rows run along
   * \param region the pixels that are written; others are left alone
   */
  SubdivisionTileWriter(TImage * image, const unsigned int laneAxis, const RegionType & region)
    : m_Image(image)
    , m_LaneAxis(laneAxis)
    , m_Region(region)
    , m_Begin(region.GetIndex(laneAxis))
    , m_End(m_Begin + static_cast<IndexValueType>(region.GetSize(laneAxis)))
    , m_Components(image->GetNumberOfComponentsPerPixel())
    , m_Stride(m_Components * image->GetOffsetTable()[laneAxis])
  {}

  /** Writes one component of the children of \c parents voxels, from the index of the first one's lower child on.
   * Returns how many lie in the region and were written. */
  SizeValueType
  WriteChildren(const IndexType &   index,
                const LanePair &    children,
                const SizeValueType parents,
                const unsigned int  component)
  {
    ComponentType * const pixels = this->FindRow(index);
    if (!pixels)
    {
      return 0;
    }
    const IndexValueType begin = index[m_LaneAxis];
    const auto           count = static_cast<IndexValueType>(SubdivisionMasks::Children * parents);
    if (m_Stride == 1 && m_Begin == begin && m_End == begin + count)
    {
      Interleave(children, parents, pixels + component);
    }
    else
    {
      // A row that begins or ends with half a voxel, or whose pixels do not lie side by side.
      this->ReserveRow(count);
      Interleave(children, parents, m_Row.get());
      for (IndexValueType i = m_Begin; i < m_End; ++i)
      {
        pixels[(i - m_Begin) * m_Stride + component] = m_Row[i - begin];
      }
    }
    return m_Region.GetSize(m_LaneAxis);
  }

  /** Asks for the memory of a row that will be written soon. */
  void
  PrefetchRow(const IndexType & index) const
  {
    if (ComponentType * const pixels = this->FindRow(index))
    {
      SubdivisionPrefetch(pixels, pixels + (m_End - m_Begin) * m_Stride);
    }
  }

  /** Writes one component of a row of values as they are. */
  void
  WriteRow(const IndexType & index, const TReal * values, const SizeValueType count, const unsigned int component) const
  {
    ComponentType * const pixels = this->FindRow(index) + component;
    for (SizeValueType i = 0; i < count; ++i)
    {
      pixels[static_cast<OffsetValueType>(i) * m_Stride] = SubdivisionRound<ComponentType>(values[i]);
    }
  }

private:
  /** Where the region begins in the row of a pixel; null if the row lies outside it. */
  ComponentType *
  FindRow(const IndexType & index) const
  {
    const IndexType & bufferStart = m_Image->GetBufferedRegion().GetIndex();
    OffsetValueType   offset = 0;
    for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
    {
      const IndexValueType regionStart = m_Region.GetIndex(axis);
      const IndexValueType i = axis == m_LaneAxis ? regionStart : index[axis];
      if (i < regionStart || i >= regionStart + static_cast<IndexValueType>(m_Region.GetSize(axis)))
      {
        return nullptr;
      }
      offset += (i - bufferStart[axis]) * m_Image->GetOffsetTable()[axis];
    }
    return reinterpret_cast<ComponentType *>(m_Image->GetBufferPointer()) + offset * m_Components;
  }

  void
  ReserveRow(const IndexValueType count)
  {
    if (m_RowLength < count)
    {
      m_Row.reset(new ComponentType[count]);
      m_RowLength = count;
    }
  }

  static void
  Interleave(const LanePair & children, const SizeValueType parents, ComponentType * const out)
  {
    using VectorPixelType = SubdivisionVectorPixelType<ComponentType>;
    if constexpr (std::is_same<TReal, float>::value && !std::is_void<VectorPixelType>::value)
    {
      InterleaveChildren(children.Lower, children.Upper, parents, reinterpret_cast<VectorPixelType *>(out));
    }
    else
    {
      for (SizeValueType i = 0; i < parents; ++i)
      {
        out[2 * i] = SubdivisionRound<ComponentType>(children.Lower[i]);
        out[2 * i + 1] = SubdivisionRound<ComponentType>(children.Upper[i]);
      }
    }
  }

  TImage *        m_Image;
  unsigned int    m_LaneAxis;
  RegionType      m_Region;
  IndexValueType  m_Begin;
  IndexValueType  m_End;
  OffsetValueType m_Components;
  OffsetValueType m_Stride;

  std::unique_ptr<ComponentType[]> m_Row;
  IndexValueType                   m_RowLength{ 0 };
};

} // namespace itk

#endif
