// SPDX-License-Identifier: Apache-2.0
#ifndef PixelComponent_h
#define PixelComponent_h

#include "itkImageIOBase.h"

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/** The components that pixels are made of, by ITK's name for what stands in a file. */
using PixelComponent = itk::IOComponentEnum;

template <typename T>
inline constexpr PixelComponent PixelComponentOf = itk::ImageIOBase::MapPixelType<T>::CType;

/** Calls \c function with a value of the C++ type of a component. */
template <typename TFunction>
auto
WithComponentType(PixelComponent component, TFunction && function)
{
  switch (component)
  {
    case PixelComponentOf<unsigned char>:
      return function(std::uint8_t{});
    case PixelComponentOf<signed char>:
      return function(std::int8_t{});
    case PixelComponentOf<unsigned short>:
      return function(std::uint16_t{});
    case PixelComponentOf<short>:
      return function(std::int16_t{});
    case PixelComponentOf<unsigned int>:
      return function(std::uint32_t{});
    case PixelComponentOf<int>:
      return function(std::int32_t{});
    case PixelComponentOf<unsigned long>:
    case PixelComponentOf<unsigned long long>:
      return function(std::uint64_t{});
    case PixelComponentOf<long>:
    case PixelComponentOf<long long>:
      return function(std::int64_t{});
    case PixelComponentOf<float>:
      return function(float{});
    case PixelComponentOf<double>:
      return function(double{});
    default:
      throw std::runtime_error("pixels of the type " + itk::ImageIOBase::GetComponentTypeAsString(component) +
                               " are not supported");
  }
}

/** uint8, int8, ..., float, double. */
std::vector<std::string>
GetPixelComponentNames();

std::string
GetPixelComponentName(PixelComponent component);

PixelComponent
GetPixelComponent(const std::string & name);

/** Bytes of one component. */
std::size_t
GetPixelComponentSize(PixelComponent component);

/** Converts real values to another component type as the filter does: integers are rounded to nearest, ties to even,
 * and saturate; NaN becomes 0. */
void
ConvertReals(const float * in, std::size_t count, PixelComponent component, void * out);
void
ConvertReals(const double * in, std::size_t count, PixelComponent component, void * out);

/** The range of pixel components, not-a-number left out. */
struct PixelRange
{
  double Minimum = std::numeric_limits<double>::infinity();
  double Maximum = -std::numeric_limits<double>::infinity();

  void
  Include(PixelComponent component, const void * values, std::size_t count);
};

#endif
