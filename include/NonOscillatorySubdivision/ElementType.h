// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_ElementType_h
#define NonOscillatorySubdivision_ElementType_h

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace itk
{
namespace Subdivision
{

/** \brief The type of the elements of an array, as a value. */
enum class ElementType : std::uint8_t
{
  UInt8,
  Int8,
  UInt16,
  Int16,
  UInt32,
  Int32,
  UInt64,
  Int64,
  Float,
  Double
};

inline constexpr std::size_t NumberOfElementTypes = static_cast<std::size_t>(ElementType::Double) + 1;

/** Stands for a type where a type is to be passed as a value. */
template <typename T>
struct TypeTag
{
  using Type = T;
};

/** Calls \c function with the TypeTag of an element type: the one place that lists the C++ types. */
template <typename TFunction>
constexpr decltype(auto)
WithElementType(const ElementType type, TFunction && function)
{
  switch (type)
  {
    case ElementType::UInt8:
      return std::forward<TFunction>(function)(TypeTag<std::uint8_t>{});
    case ElementType::Int8:
      return std::forward<TFunction>(function)(TypeTag<std::int8_t>{});
    case ElementType::UInt16:
      return std::forward<TFunction>(function)(TypeTag<std::uint16_t>{});
    case ElementType::Int16:
      return std::forward<TFunction>(function)(TypeTag<std::int16_t>{});
    case ElementType::UInt32:
      return std::forward<TFunction>(function)(TypeTag<std::uint32_t>{});
    case ElementType::Int32:
      return std::forward<TFunction>(function)(TypeTag<std::int32_t>{});
    case ElementType::UInt64:
      return std::forward<TFunction>(function)(TypeTag<std::uint64_t>{});
    case ElementType::Int64:
      return std::forward<TFunction>(function)(TypeTag<std::int64_t>{});
    case ElementType::Float:
      return std::forward<TFunction>(function)(TypeTag<float>{});
    case ElementType::Double:
      return std::forward<TFunction>(function)(TypeTag<double>{});
  }
  throw std::invalid_argument("no such element type");
}

/** The element type with the size and kind of a C++ type, so that `long` and `char` have one, too. */
template <typename T>
constexpr ElementType
ElementTypeOf()
{
  static_assert(std::is_arithmetic<T>::value && sizeof(T) <= 8,
                "elements are integers of 8 to 64 bits, float or double");
  if constexpr (std::is_floating_point<T>::value)
  {
    return sizeof(T) == sizeof(float) ? ElementType::Float : ElementType::Double;
  }
  else
  {
    constexpr int width = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 2 : sizeof(T) == 4 ? 4 : 6;
    return static_cast<ElementType>(width + (std::is_signed<T>::value ? 1 : 0));
  }
}

/** Bytes of an element. */
constexpr std::size_t
SizeOf(const ElementType type)
{
  return WithElementType(type, [](auto tag) { return sizeof(typename decltype(tag)::Type); });
}

constexpr bool
IsInteger(const ElementType type)
{
  return type != ElementType::Float && type != ElementType::Double;
}

/** Whether float is not enough to compute with such elements: 16 bits and less are exact in it. */
constexpr bool
NeedsDouble(const ElementType type)
{
  return type != ElementType::Float && SizeOf(type) > 2;
}

/** The name of an element type: uint8 ... int64, float, double. */
constexpr const char *
GetName(const ElementType type)
{
  constexpr const char * names[] = { "uint8", "int8",   "uint16", "int16", "uint32",
                                     "int32", "uint64", "int64",  "float", "double" };
  return names[static_cast<std::size_t>(type)];
}

} // namespace Subdivision
} // namespace itk

#endif
