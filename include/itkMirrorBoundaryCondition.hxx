// SPDX-License-Identifier: Apache-2.0
#ifndef itkMirrorBoundaryCondition_hxx
#define itkMirrorBoundaryCondition_hxx

#include <algorithm>

namespace itk
{

template <typename TInputImage, typename TOutputImage>
auto
MirrorBoundaryCondition<TInputImage, TOutputImage>::FindMirrorImage(const OffsetType &       point_index,
                                                                    const OffsetType &       boundary_offset,
                                                                    const NeighborhoodType * data) -> PixelPointerType
{
  OffsetValueType position = 0;
  for (unsigned int i = 0; i < ImageDimension; ++i)
  {
    // As far inside the outermost pixel as the point lies outside it, less the one step across the face.
    const OffsetValueType face = (boundary_offset[i] > 0) - (boundary_offset[i] < 0);
    position += (point_index[i] + 2 * boundary_offset[i] - face) * static_cast<OffsetValueType>(data->GetStride(i));
  }
  return (*data)[static_cast<unsigned int>(position)];
}

template <typename TInputImage, typename TOutputImage>
auto
MirrorBoundaryCondition<TInputImage, TOutputImage>::operator()(const OffsetType &       point_index,
                                                               const OffsetType &       boundary_offset,
                                                               const NeighborhoodType * data) const -> OutputPixelType
{
  // A pointer to a whole pixel, except for VectorImage, which is read through the functor below.
  return static_cast<OutputPixelType>(
    *reinterpret_cast<PixelType *>(FindMirrorImage(point_index, boundary_offset, data)));
}

template <typename TInputImage, typename TOutputImage>
auto
MirrorBoundaryCondition<TInputImage, TOutputImage>::operator()(
  const OffsetType &                      point_index,
  const OffsetType &                      boundary_offset,
  const NeighborhoodType *                data,
  const NeighborhoodAccessorFunctorType & neighborhoodAccessorFunctor) const -> OutputPixelType
{
  return static_cast<OutputPixelType>(
    neighborhoodAccessorFunctor.Get(FindMirrorImage(point_index, boundary_offset, data)));
}

template <typename TInputImage, typename TOutputImage>
auto
MirrorBoundaryCondition<TInputImage, TOutputImage>::GetInputRequestedRegion(
  const RegionType & inputLargestPossibleRegion,
  const RegionType & outputRequestedRegion) const -> RegionType
{
  RegionType request = outputRequestedRegion;
  for (unsigned int i = 0; i < ImageDimension; ++i)
  {
    const IndexValueType start = inputLargestPossibleRegion.GetIndex(i);
    const auto           size = static_cast<IndexValueType>(inputLargestPossibleRegion.GetSize(i));
    const IndexValueType first = outputRequestedRegion.GetIndex(i) - start;
    const IndexValueType last = first + static_cast<IndexValueType>(outputRequestedRegion.GetSize(i)) - 1;

    // Between reflections the map is monotonous; at each of them it takes an end of the image along.
    IndexValueType lowest = std::min(MirrorIndex(first, size), MirrorIndex(last, size));
    IndexValueType highest = std::max(MirrorIndex(first, size), MirrorIndex(last, size));
    const auto     floorOfRatio = [size](const IndexValueType n) { return (n - (n % size + size) % size) / size; };
    for (IndexValueType face = floorOfRatio(first) + 1; face <= floorOfRatio(last); ++face)
    {
      (face % 2 == 0 ? lowest : highest) = (face % 2 == 0 ? 0 : size - 1);
    }
    request.SetIndex(i, start + lowest);
    request.SetSize(i, static_cast<SizeValueType>(highest - lowest + 1));
  }
  return request;
}

template <typename TInputImage, typename TOutputImage>
auto
MirrorBoundaryCondition<TInputImage, TOutputImage>::GetPixel(const IndexType & index, const TInputImage * image) const
  -> OutputPixelType
{
  const RegionType region = image->GetLargestPossibleRegion();
  IndexType        inside;
  for (unsigned int i = 0; i < ImageDimension; ++i)
  {
    const IndexValueType start = region.GetIndex(i);
    inside[i] = start + MirrorIndex(index[i] - start, static_cast<IndexValueType>(region.GetSize(i)));
  }
  return static_cast<OutputPixelType>(image->GetPixel(inside));
}

} // namespace itk

#endif
