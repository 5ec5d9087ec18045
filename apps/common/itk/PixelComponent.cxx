// SPDX-License-Identifier: Apache-2.0
#include "itk/PixelComponent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace
{
const std::vector<std::pair<std::string, PixelComponent>> NamedComponents = {
  { "uint8", PixelComponentOf<std::uint8_t> },   { "int8", PixelComponentOf<std::int8_t> },
  { "uint16", PixelComponentOf<std::uint16_t> }, { "int16", PixelComponentOf<std::int16_t> },
  { "uint32", PixelComponentOf<std::uint32_t> }, { "int32", PixelComponentOf<std::int32_t> },
  { "uint64", PixelComponentOf<std::uint64_t> }, { "int64", PixelComponentOf<std::int64_t> },
  { "float", PixelComponentOf<float> },          { "double", PixelComponentOf<double> },
};

template <typename TOut, typename TReal>
TOut
ConvertReal(TReal value)
{
  if constexpr (std::is_integral_v<TOut>)
  {
    if (std::isnan(value))
    {
      return 0;
    }
    // The largest integer need not be a real number; the real number next to it is already too large.
    const TReal rounded = std::nearbyint(value);
    if (rounded >= static_cast<TReal>(std::numeric_limits<TOut>::max()))
    {
      return std::numeric_limits<TOut>::max();
    }
    if (rounded <= static_cast<TReal>(std::numeric_limits<TOut>::lowest()))
    {
      return std::numeric_limits<TOut>::lowest();
    }
    return static_cast<TOut>(rounded);
  }
  else
  {
    return static_cast<TOut>(value);
  }
}

template <typename TReal>
void
Convert(const TReal * in, std::size_t count, PixelComponent component, void * out)
{
  WithComponentType(component, [&](auto type) {
    using OutType = decltype(type);
    std::transform(in, in + count, static_cast<OutType *>(out), ConvertReal<OutType, TReal>);
  });
}

/** Several running ranges side by side, so that the compiler can use vector instructions. */
template <typename T>
std::pair<T, T>
GetRange(const T * values, std::size_t count)
{
  constexpr std::size_t lanes = 64 / sizeof(T);
  constexpr bool        isReal = std::is_floating_point_v<T>;
  constexpr T           highest = isReal ? std::numeric_limits<T>::infinity() : std::numeric_limits<T>::max();
  constexpr T           lowest = isReal ? -std::numeric_limits<T>::infinity() : std::numeric_limits<T>::lowest();
  std::array<T, lanes>  minima;
  std::array<T, lanes>  maxima;
  minima.fill(highest);
  maxima.fill(lowest);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      const T value = values[i + lane];
      minima[lane] = value < minima[lane] ? value : minima[lane];
      maxima[lane] = value > maxima[lane] ? value : maxima[lane];
    }
  }
  for (; i < count; ++i)
  {
    minima[0] = values[i] < minima[0] ? values[i] : minima[0];
    maxima[0] = values[i] > maxima[0] ? values[i] : maxima[0];
  }
  return { *std::min_element(minima.begin(), minima.end()), *std::max_element(maxima.begin(), maxima.end()) };
}
} // namespace

std::vector<std::string>
GetPixelComponentNames()
{
  std::vector<std::string> names;
  for (const auto & named : NamedComponents)
  {
    names.push_back(named.first);
  }
  return names;
}

std::string
GetPixelComponentName(PixelComponent component)
{
  return WithComponentType(component, [](auto type) {
    const auto isThis = [](const auto & named) { return named.second == PixelComponentOf<decltype(type)>; };
    return std::find_if(NamedComponents.begin(), NamedComponents.end(), isThis)->first;
  });
}

PixelComponent
GetPixelComponent(const std::string & name)
{
  const auto isThis = [&name](const auto & named) { return named.first == name; };
  const auto found = std::find_if(NamedComponents.begin(), NamedComponents.end(), isThis);
  if (found == NamedComponents.end())
  {
    throw std::runtime_error("there is no pixel type " + name);
  }
  return found->second;
}

std::size_t
GetPixelComponentSize(PixelComponent component)
{
  return WithComponentType(component, [](auto type) { return sizeof(type); });
}

void
ConvertReals(const float * in, std::size_t count, PixelComponent component, void * out)
{
  Convert(in, count, component, out);
}

void
ConvertReals(const double * in, std::size_t count, PixelComponent component, void * out)
{
  Convert(in, count, component, out);
}

void
PixelRange::Include(PixelComponent component, const void * values, std::size_t count)
{
  WithComponentType(component, [&](auto type) {
    const auto range = GetRange(static_cast<const decltype(type) *>(values), count);
    Minimum = std::min(Minimum, static_cast<double>(range.first));
    Maximum = std::max(Maximum, static_cast<double>(range.second));
  });
}
