// SPDX-License-Identifier: Apache-2.0

// The table of what one target offers. No include guard: every target includes this file once, into its own namespace.

#include "kernel/Sweep-inl.h"

namespace itk
{
namespace Subdivision
{
namespace SUBDIVISION_TARGET
{

template <typename TElement, typename T>
void
Widen(const void * const elements, const std::size_t count, T * const values)
{
  WidenElements(static_cast<const TElement *>(elements), count, values);
}

template <typename TElement, typename T>
void
Narrow(const T * const values, const std::size_t count, void * const elements)
{
  NarrowValues(values, count, static_cast<TElement *>(elements));
}

template <typename TElement, typename T>
void
Interleave(const T * const children, const std::size_t count, void * const elements)
{
  InterleaveChildren(children, count, static_cast<TElement *>(elements));
}

template <typename T>
constexpr TargetFunctions<T>
MakeFunctions()
{
  TargetFunctions<T> functions{ &MakeSweep<T>, {}, {}, {} };
  for (std::size_t type = 0; type < NumberOfElementTypes; ++type)
  {
    WithElementType(static_cast<ElementType>(type), [&functions, type](const auto tag) {
      using Element = typename decltype(tag)::Type;
      functions.Widen[type] = &Widen<Element, T>;
      functions.Narrow[type] = &Narrow<Element, T>;
      functions.InterleaveChildren[type] = &Interleave<Element, T>;
    });
  }
  return functions;
}

constexpr TargetTable
MakeTable(const char * name)
{
  return { name, MakeFunctions<float>(), MakeFunctions<double>() };
}

} // namespace SUBDIVISION_TARGET
} // namespace Subdivision
} // namespace itk
