// SPDX-License-Identifier: Apache-2.0
#ifndef itkMirrorBoundaryCondition_h
#define itkMirrorBoundaryCondition_h

#include "itkImageBoundaryCondition.h"

namespace itk
{

/** Maps an index, counted from the start of an axis of \c size pixels, into [0, size) by reflections at the outer faces
 * of its first and last pixel: ... 1 0 | 0 1 ... size-1 | size-1 size-2 ... */
inline IndexValueType
MirrorIndex(const IndexValueType index, const IndexValueType size)
{
  const IndexValueType period = 2 * size;
  const IndexValueType folded = (index % period + period) % period;
  return folded < size ? folded : period - 1 - folded;
}

/** \class MirrorBoundaryCondition
 *
 * \brief Continues an image by half-sample symmetric reflection: across a face of the image lie its outermost pixels
 * once more, in reverse order.
 *
 * Image data must be of the same dimension as the neighborhood. An index may lie any distance outside the image.
 *
 * \ingroup ImageFunctions
 * \ingroup NonOscillatorySubdivision
 */
template <typename TInputImage, typename TOutputImage = TInputImage>
class ITK_TEMPLATE_EXPORT MirrorBoundaryCondition : public ImageBoundaryCondition<TInputImage, TOutputImage>
{
public:
  using Self = MirrorBoundaryCondition;
  using Superclass = ImageBoundaryCondition<TInputImage, TOutputImage>;

  using typename Superclass::IndexType;
  using typename Superclass::NeighborhoodAccessorFunctorType;
  using typename Superclass::NeighborhoodType;
  using typename Superclass::OffsetType;
  using typename Superclass::OutputPixelType;
  using typename Superclass::PixelType;
  using typename Superclass::PixelPointerType;
  using typename Superclass::RegionType;

  static constexpr unsigned int ImageDimension = Superclass::ImageDimension;

  MirrorBoundaryCondition() = default;

  const char *
  GetNameOfClass() const override
  {
    return "itkMirrorBoundaryCondition";
  }

  /** The pixel that a neighborhood reaches \c boundary_offset beyond its nearest pixel inside the image. The
   * neighborhood's radius must not exceed the image's size.
   * @{ */
  OutputPixelType
  operator()(const OffsetType &       point_index,
             const OffsetType &       boundary_offset,
             const NeighborhoodType * data) const override;

  OutputPixelType
  operator()(const OffsetType &                      point_index,
             const OffsetType &                      boundary_offset,
             const NeighborhoodType *                data,
             const NeighborhoodAccessorFunctorType & neighborhoodAccessorFunctor) const override;
  /** @} */

  /** The part of the image that a region, which may reach beyond the image, depends on. */
  RegionType
  GetInputRequestedRegion(const RegionType & inputLargestPossibleRegion,
                          const RegionType & outputRequestedRegion) const override;

  /** The pixel at an index, inside or outside the image. */
  OutputPixelType
  GetPixel(const IndexType & index, const TInputImage * image) const override;

private:
  /** Where in the neighborhood the mirror image of a pixel outside the image lies. */
  static PixelPointerType
  FindMirrorImage(const OffsetType & point_index, const OffsetType & boundary_offset, const NeighborhoodType * data);
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#  include "itkMirrorBoundaryCondition.hxx"
#endif

#endif
