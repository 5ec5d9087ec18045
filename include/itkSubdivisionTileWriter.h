// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionTileWriter_h
#define itkSubdivisionTileWriter_h

#include "itkStreamPastCache.h"
#include "itkSubdivisionKernel.h"
#include "itkSubdivisionMasks.h"
#include "itkSubdivisionPixelTraits.h"
#include "itkSubdivisionTileAxes.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace itk
{

/** \class SubdivisionTileWriter
 *
 * \brief Scatters the rows of children of a tile into an image, rounded and clamped as its pixels need it.
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

  /**
   * \param image the image
   * \param axes the axes of the tile
   * \param region the pixels that are written; others are left alone
   */
  SubdivisionTileWriter(TImage * image, const SubdivisionTileAxes & axes, const RegionType & region)
    : m_Image(image)
    , m_Axes(axes)
    , m_Region(region)
    , m_Components(image->GetNumberOfComponentsPerPixel())
    , m_Stride(m_Components * image->GetOffsetTable()[axes.GetLanes()])
    , m_Begin(region.GetIndex(axes.GetLanes()))
    , m_End(m_Begin + static_cast<IndexValueType>(region.GetSize(axes.GetLanes())))
    , m_IsLarge(image->GetBufferedRegion().GetNumberOfPixels() * m_Components * sizeof(ComponentType) > CacheSize)
  {}

  /** Chooses the position along the axes that are not the tile's, and the component that is written. */
  void
  SetImage(const IndexType & position, const unsigned int component)
  {
    m_Pixels = m_Axes.template FindImage<ComponentType>(m_Image, position) + component;
  }

  /** Writes those children of a row of \c parents voxels that lie in the region; returns how many these are. The
   * indices are those of the first child, along the axes that the tile has. */
  SizeValueType
  WriteChildren(const TReal * const  children,
                const SizeValueType  parents,
                const IndexValueType lane,
                const IndexValueType row,
                const IndexValueType plane)
  {
    ComponentType * const pixels = this->FindRow(row, plane);
    if (!pixels)
    {
      return 0;
    }
    const auto count = static_cast<IndexValueType>(SubdivisionMasks::Children * parents);
    const bool isWholeRow = m_Stride == 1 && m_Begin == lane && m_End == lane + count;
    if (isWholeRow && !m_IsLarge)
    {
      this->Interleave(children, parents, pixels);
    }
    else
    {
      this->ReserveRow(count);
      this->Interleave(children, parents, m_Row.get());
      if (isWholeRow)
      {
        StreamPastCache & stream = m_Streams[static_cast<std::size_t>(plane) % m_Streams.size()];
        stream.Copy(m_Row.get(), count * sizeof(ComponentType), pixels);
      }
      else
      {
        // A row that begins or ends with half a voxel, or whose pixels do not lie side by side.
        for (IndexValueType i = m_Begin; i < m_End; ++i)
        {
          pixels[(i - m_Begin) * m_Stride] = m_Row[i - lane];
        }
      }
    }
    return static_cast<SizeValueType>(m_End - m_Begin);
  }

  /** Writes a row of the region as it is; returns the number of pixels. */
  SizeValueType
  WriteRow(const TReal * const values) const
  {
    ComponentType * const pixels = m_Pixels + m_Begin * m_Stride;
    for (IndexValueType i = 0; i < m_End - m_Begin; ++i)
    {
      pixels[i * m_Stride] = SubdivisionRound<ComponentType>(values[i]);
    }
    return static_cast<SizeValueType>(m_End - m_Begin);
  }

private:
  /** The last-level cache of common processors, in bytes. */
  static constexpr std::size_t CacheSize = std::size_t{ 16 } << 20;

  bool
  IsInRegion(const unsigned int axis, const IndexValueType index) const
  {
    const IndexValueType begin = m_Region.GetIndex(axis);
    return index >= begin && index < begin + static_cast<IndexValueType>(m_Region.GetSize(axis));
  }

  /** Where the region begins in a row; null if the row lies outside it. */
  ComponentType *
  FindRow(const IndexValueType row, const IndexValueType plane) const
  {
    OffsetValueType offset = m_Begin * m_Stride;
    if (m_Axes.HasRows())
    {
      if (!this->IsInRegion(m_Axes.GetRows(), row))
      {
        return nullptr;
      }
      offset += row * m_Image->GetOffsetTable()[m_Axes.GetRows()] * m_Components;
    }
    if (m_Axes.HasSweep())
    {
      if (!this->IsInRegion(m_Axes.GetSweep(), plane))
      {
        return nullptr;
      }
      offset += plane * m_Image->GetOffsetTable()[m_Axes.GetSweep()] * m_Components;
    }
    return m_Pixels + offset;
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

  void
  Interleave(const TReal * const children, const SizeValueType parents, ComponentType * const out)
  {
    using VectorPixelType = SubdivisionVectorPixelType<ComponentType>;
    if constexpr (std::is_same<TReal, float>::value && !std::is_void<VectorPixelType>::value)
    {
      InterleaveChildren(children, parents, reinterpret_cast<VectorPixelType *>(out));
    }
    else
    {
      m_Values.resize(SubdivisionMasks::Children * parents);
      InterleaveChildren(children, parents, m_Values.data());
      std::transform(m_Values.begin(), m_Values.end(), out, &SubdivisionRound<ComponentType, TReal>);
    }
  }

  TImage *            m_Image;
  SubdivisionTileAxes m_Axes;
  RegionType          m_Region;
  OffsetValueType     m_Components;
  OffsetValueType     m_Stride;

  /** The region along the lanes. */
  IndexValueType m_Begin;
  IndexValueType m_End;

  /** Whether the image is too large for who reads it to find much of it in the cache. */
  bool m_IsLarge;

  ComponentType * m_Pixels{ nullptr };

  /** Rows of a plane follow one another; those of as many planes come in turns. */
  std::array<StreamPastCache, SubdivisionMasks::Children * SubdivisionKernel<TReal>::PlanesPerStep> m_Streams;

  /** A row before it is rounded, and before it is copied to where it belongs. */
  std::vector<TReal>               m_Values;
  std::unique_ptr<ComponentType[]> m_Row;
  IndexValueType                   m_RowLength{ 0 };
};

} // namespace itk

#endif
