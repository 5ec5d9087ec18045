// SPDX-License-Identifier: Apache-2.0

// The table of what one target offers. No include guard: every target includes this file once, into its own namespace.

#include "kernel/Sweep-inl.h"

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

template <typename T>
void
Widen(const ElementType type, const void * const elements, const std::size_t count, T * const values)
{
  WithElementType(type, [=](const auto tag) {
    WidenElements(static_cast<const typename decltype(tag)::Type *>(elements), count, values);
  });
}

template <typename T>
void
Narrow(const ElementType type, const T * const values, const std::size_t count, void * const elements)
{
  WithElementType(
    type, [=](const auto tag) { NarrowValues(values, count, static_cast<typename decltype(tag)::Type *>(elements)); });
}

template <typename T>
void
Interleave(const ElementType type, const T * const children, const std::size_t count, void * const elements)
{
  WithElementType(type, [=](const auto tag) {
    InterleaveChildren(children, count, static_cast<typename decltype(tag)::Type *>(elements));
  });
}

template <typename T>
constexpr TargetFunctions<T>
MakeFunctions()
{
  return { &MakeSweep<T>, &Widen<T>, &Narrow<T>, &Interleave<T> };
}

constexpr TargetTable
MakeTable(const char * name)
{
  return { name, MakeFunctions<float>(), MakeFunctions<double>() };
}

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
