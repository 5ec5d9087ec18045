// SPDX-License-Identifier: Apache-2.0
#ifndef BoundaryCondition_h
#define BoundaryCondition_h

#include "itkConstantBoundaryCondition.h"
#include "itkMirrorBoundaryCondition.h"
#include "itkPeriodicBoundaryCondition.h"
#include "itkZeroFluxNeumannBoundaryCondition.h"

#include "itkDefaultConvertPixelTraits.h"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

/** A number as a pixel component.
 * \throw std::runtime_error if the type does not have it */
template <typename TComponent>
TComponent
ParseComponent(const std::string & text)
{
  const double value = std::stod(text);
  // The bounds are powers of two, so they are exact; the largest 64-bit integer is not a double, but one below it is.
  const bool isOne =
    std::is_floating_point_v<TComponent> ||
    (value == std::floor(value) && value >= static_cast<double>(std::numeric_limits<TComponent>::min()) &&
     value < std::ldexp(1.0, std::numeric_limits<TComponent>::digits));
  if (!isOne)
  {
    throw std::runtime_error("the boundary value " + text + " is not one that a voxel of this image can have");
  }
  return static_cast<TComponent>(value);
}

/** What lies beyond the image: "nearest", "mirror", "periodic" or a value. */
template <typename TImage>
std::unique_ptr<itk::ImageBoundaryCondition<TImage>>
MakeBoundaryCondition(const std::string & name, unsigned int numberOfComponents)
{
  using ComponentType = typename TImage::InternalPixelType;
  if (name == "nearest")
  {
    return std::make_unique<itk::ZeroFluxNeumannBoundaryCondition<TImage>>();
  }
  if (name == "mirror")
  {
    return std::make_unique<itk::MirrorBoundaryCondition<TImage>>();
  }
  if (name == "periodic")
  {
    return std::make_unique<itk::PeriodicBoundaryCondition<TImage>>();
  }
  const auto                 value = ParseComponent<ComponentType>(name);
  auto                       condition = std::make_unique<itk::ConstantBoundaryCondition<TImage>>();
  typename TImage::PixelType pixel{};
  itk::NumericTraits<typename TImage::PixelType>::SetLength(pixel, numberOfComponents);
  pixel = pixel + value;
  condition->SetConstant(pixel);
  return condition;
}

#endif
