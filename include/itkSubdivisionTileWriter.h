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
    , m_Components(image->GetNumberOfComponentsPerPixel())
    , m_Stride(m_Components * image->GetOffsetTable()[laneAxis])
  {}

  /** Writes one component of the children of \c parents voxels, from the index of the first one's lower child on.
   * Returns how many lie in the region and were written. */
  SizeValueType
  WriteChildren(IndexType          index,
                const LanePair &   children,
                const SizeValueType parents,
                const unsigned int component)
  {
    const IndexValueType begin = index[m_LaneAxis];
    const IndexValueType regionBegin = m_Region.GetIndex(m_LaneAxis);
    const IndexValueType regionEnd = regionBegin + static_cast<IndexValueType>(m_Region.GetSize(m_LaneAxis));
    index[m_LaneAxis] = regionBegin;
    if (!m_Region.IsInside(index))
    {
      return 0;
    }
    ComponentType * const pixels = this->ComponentsAt(index) + component;

    const auto count = static_cast<IndexValueType>(SubdivisionMasks::Children * parents);
    if (m_Stride == 1 && regionBegin == begin && regionEnd == begin + count)
    {
      Interleave(children, parents, pixels);
      return m_Region.GetSize(m_LaneAxis);
    }
    // A row that begins or ends with half a voxel, or whose pixels do not lie side by side.
    if (m_RowLength < count)
    {
      m_Row.reset(new ComponentType[count]);
      m_RowLength = count;
    }
    Interleave(children, parents, m_Row.get());
    for (IndexValueType i = regionBegin; i < regionEnd; ++i)
    {
      pixels[(i - regionBegin) * m_Stride] = m_Row[i - begin];
    }
    return m_Region.GetSize(m_LaneAxis);
  }

  /** Writes one component of a row of values as they are. */
  void
  WriteRow(const IndexType & index, const TReal * values, const SizeValueType count, const unsigned int component) const
  {
    ComponentType * const pixels = this->ComponentsAt(index) + component;
    for (SizeValueType i = 0; i < count; ++i)
    {
      pixels[static_cast<OffsetValueType>(i) * m_Stride] = SubdivisionRound<ComponentType>(values[i]);
    }
  }

private:
  ComponentType *
  ComponentsAt(const IndexType & index) const
  {
    auto * const components = reinterpret_cast<ComponentType *>(m_Image->GetBufferPointer());
    return components + m_Image->ComputeOffset(index) * m_Components;
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
  OffsetValueType m_Components;
  OffsetValueType m_Stride;

  std::unique_ptr<ComponentType[]> m_Row;
  IndexValueType                   m_RowLength{ 0 };
};

} // namespace itk

#endif
