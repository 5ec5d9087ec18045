// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionImageView_h
#define itkSubdivisionImageView_h

#include "NonOscillatorySubdivision/ArrayView.h"
#include "NonOscillatorySubdivision/Boundary.h"
#include "NonOscillatorySubdivision/DefaultFloatingPoint.h"
#include "itkMirrorBoundaryCondition.h"

#include "itkConstantBoundaryCondition.h"
#include "itkImage.h"
#include "itkMacro.h"
#include "itkNumericTraits.h"
#include "itkPeriodicBoundaryCondition.h"
#include "itkVectorImage.h"
#include "itkZeroFluxNeumannBoundaryCondition.h"

#include <cstring>
#include <memory>
#include <type_traits>
#include <typeinfo>
#include <vector>

// NonOscillatorySubdivisionImageFilter's view of images and boundary conditions: as arrays, whose axis 0 is that of the
// components of pixels.

namespace itk
{
namespace Detail
{

/** The type of one component of an image's pixels, the parts of a complex number among them. */
template <typename TImage>
using SubdivisionComponentType = typename NumericTraits<typename TImage::PixelType>::ValueType;

template <typename TImage>
constexpr bool IsVectorImage =
  std::is_base_of<VectorImage<SubdivisionComponentType<TImage>, TImage::ImageDimension>, TImage>::value;

/** Whether an image has a buffer of its own, whose pixels lie on a grid: an itk::Image or itk::VectorImage. */
template <typename TImage>
constexpr bool IsBufferedGrid =
  IsVectorImage<TImage> || std::is_base_of<Image<typename TImage::PixelType, TImage::ImageDimension>, TImage>::value;

/** Whether the pixels in an image's buffer are components that lie side by side, each with an element type. */
template <typename TImage>
constexpr bool HasElements =
  std::is_arithmetic<SubdivisionComponentType<TImage>>::value &&
  !std::is_same<SubdivisionComponentType<TImage>, long double>::value &&
  (IsVectorImage<TImage> || std::is_trivially_destructible<typename TImage::PixelType>::value);

template <typename TImage>
std::uint64_t
CountComponents(const TImage * const image)
{
  return IsVectorImage<TImage> ? image->GetNumberOfComponentsPerPixel()
                               : sizeof(typename TImage::PixelType) / sizeof(SubdivisionComponentType<TImage>);
}

template <typename TImage>
Subdivision::Box
ToBox(const TImage * const image, const typename TImage::RegionType & region)
{
  Subdivision::Box box{ { 0, CountComponents(image) } };
  for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
  {
    box.push_back({ region.GetIndex(axis), region.GetSize(axis) });
  }
  return box;
}

template <unsigned int VDimension>
ImageRegion<VDimension>
ToRegion(const Subdivision::Box & box)
{
  ImageRegion<VDimension> region;
  for (unsigned int axis = 0; axis < VDimension; ++axis)
  {
    region.SetIndex(axis, static_cast<IndexValueType>(box[axis + 1].First));
    region.SetSize(axis, static_cast<SizeValueType>(box[axis + 1].Size));
  }
  return region;
}

/** A region of an image's buffer, \c TVoid being \c const \c void for a constant image. */
template <typename TVoid, typename TImage>
Subdivision::BasicArrayView<TVoid>
ViewRegion(TImage * const image, const typename TImage::RegionType & region)
{
  using ComponentType = SubdivisionComponentType<TImage>;
  const auto      components = static_cast<OffsetValueType>(CountComponents(image));
  OffsetValueType begin = 0;

  Subdivision::BasicArrayView<TVoid> view{ nullptr, Subdivision::ElementTypeOf<ComponentType>(), {} };
  view.Axes.push_back({ 0, static_cast<std::uint64_t>(components), 1 });
  for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
  {
    const OffsetValueType stride = image->GetOffsetTable()[axis] * components;
    view.Axes.push_back({ region.GetIndex(axis), region.GetSize(axis), stride });
    begin += (region.GetIndex(axis) - image->GetBufferedRegion().GetIndex(axis)) * stride;
  }
  using ElementPointer =
    typename std::conditional<std::is_const<TVoid>::value, const ComponentType *, ComponentType *>::type;
  view.Data = reinterpret_cast<ElementPointer>(image->GetBufferPointer()) + begin;
  return view;
}

/** A component of a pixel.
 * \throw ExceptionObject if a pixel of variable length is too short */
template <typename TImage>
double
GetComponent(const typename TImage::PixelType & pixel, const std::int64_t component)
{
  using ComponentType = SubdivisionComponentType<TImage>;
  if constexpr (IsVectorImage<TImage>)
  {
    if (component >= static_cast<std::int64_t>(pixel.GetSize()))
    {
      itkGenericExceptionMacro("The boundary condition's pixel has " << pixel.GetSize()
                                                                     << " components, fewer than those of the image");
    }
    return static_cast<double>(pixel[static_cast<unsigned int>(component)]);
  }
  else
  {
    ComponentType value;
    std::memcpy(&value, reinterpret_cast<const ComponentType *>(&pixel) + component, sizeof(value));
    return static_cast<double>(value);
  }
}

/** \class PixelsOfBoundaryCondition
 *
 * \brief Asks a boundary condition's GetPixel().
 *
 * \ingroup NonOscillatorySubdivision
 */
template <typename TImage>
class PixelsOfBoundaryCondition : public Subdivision::OutsideElements
{
public:
  using BoundaryConditionType = ImageBoundaryCondition<TImage, TImage>;

  PixelsOfBoundaryCondition(const BoundaryConditionType * condition, const TImage * image)
    : m_Condition(condition)
    , m_Image(image)
  {}

  double
  GetElement(const std::int64_t * const index) const override
  {
    typename TImage::IndexType pixel;
    for (unsigned int axis = 0; axis < TImage::ImageDimension; ++axis)
    {
      pixel[axis] = static_cast<IndexValueType>(index[axis + 1]);
    }
    return GetComponent<TImage>(m_Condition->GetPixel(pixel, m_Image), index[0]);
  }

private:
  const BoundaryConditionType * m_Condition;
  const TImage *                m_Image;
};

/** Whether a boundary condition is one of ITK's three or the mirror itself. A class derived from one of them may
 * supply other pixels and is to be asked. */
template <typename TImage>
bool
IsKnown(const ImageBoundaryCondition<TImage, TImage> & condition)
{
  const std::type_info & type = typeid(condition);
  return type == typeid(ZeroFluxNeumannBoundaryCondition<TImage, TImage>) ||
         type == typeid(MirrorBoundaryCondition<TImage, TImage>) ||
         type == typeid(PeriodicBoundaryCondition<TImage, TImage>) ||
         type == typeid(ConstantBoundaryCondition<TImage, TImage>);
}

/** The constant of each component.
 * \throw ExceptionObject if there are not as many as components of a pixel */
template <typename TImage>
std::vector<double>
GetConstants(const ConstantBoundaryCondition<TImage, TImage> & condition, const TImage * const image)
{
  // Large integers are rounded to double, and not as the caller may have chosen.
  const Subdivision::DefaultFloatingPoint environment;

  const auto          components = static_cast<std::int64_t>(CountComponents(image));
  const auto          pixel = condition.GetConstant();
  std::vector<double> constants;
  if constexpr (IsVectorImage<TImage>)
  {
    if (static_cast<std::int64_t>(pixel.GetSize()) != components)
    {
      itkGenericExceptionMacro("BoundaryCondition has a constant of " << pixel.GetSize()
                                                                      << " components, but must have " << components
                                                                      << ", as the pixels of the input");
    }
  }
  for (std::int64_t component = 0; component < components; ++component)
  {
    constants.push_back(GetComponent<TImage>(pixel, component));
  }
  return constants;
}

/** What a boundary condition does to an image. Both must live as long as what is returned. */
template <typename TImage>
Subdivision::Boundary
ToBoundary(const ImageBoundaryCondition<TImage, TImage> & condition, const TImage * const image)
{
  if (!IsKnown<TImage>(condition))
  {
    return Subdivision::Boundary::Custom(std::make_shared<PixelsOfBoundaryCondition<TImage>>(&condition, image));
  }
  if (const auto * constant = dynamic_cast<const ConstantBoundaryCondition<TImage, TImage> *>(&condition))
  {
    return Subdivision::Boundary::Constant(GetConstants<TImage>(*constant, image));
  }
  if (dynamic_cast<const MirrorBoundaryCondition<TImage, TImage> *>(&condition))
  {
    return Subdivision::Boundary::Mirror();
  }
  if (dynamic_cast<const PeriodicBoundaryCondition<TImage, TImage> *>(&condition))
  {
    return Subdivision::Boundary::Periodic();
  }
  return Subdivision::Boundary::Nearest();
}

/** The part of an image that an unknown boundary condition needs for a stencil: what it says, but for classes derived
 * from PeriodicBoundaryCondition, whose answer is wrong where the image does not begin at 0. */
template <typename TImage>
typename TImage::RegionType
AskForRequest(const ImageBoundaryCondition<TImage, TImage> & condition,
              const typename TImage::RegionType &            whole,
              const typename TImage::RegionType &            stencil)
{
  const bool isPeriodic = dynamic_cast<const PeriodicBoundaryCondition<TImage, TImage> *>(&condition);
  return isPeriodic ? whole : condition.GetInputRequestedRegion(whole, stencil);
}

} // namespace Detail
} // namespace itk

#endif
