// SPDX-License-Identifier: Apache-2.0
#ifndef TestArray_h
#define TestArray_h

#include "NonOscillatorySubdivision/ArrayView.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

/** How an array lies in memory: its axes in order, the fastest first, the sign of each one's stride, and how many
 * elements are left free after each run along an axis. */
struct TestLayout
{
  std::vector<std::size_t>    Order;
  std::vector<bool>           IsReversed;
  std::vector<std::ptrdiff_t> Free;

  /** Axis 0 the fastest, no element free. */
  static TestLayout
  Dense(const std::size_t axes)
  {
    TestLayout layout{ std::vector<std::size_t>(axes), std::vector<bool>(axes), std::vector<std::ptrdiff_t>(axes) };
    std::iota(layout.Order.begin(), layout.Order.end(), 0);
    return layout;
  }
};

/** An array of any element type, with its memory. */
class TestArray
{
public:
  using Index = std::vector<std::int64_t>;
  using ElementType = itk::Subdivision::ElementType;
  using Box = itk::Subdivision::Box;

  TestArray(const ElementType type, const Box & box, const TestLayout & layout)
    : m_Type(type)
    , m_Axes(box.size())
  {
    std::ptrdiff_t stride = 1;
    std::ptrdiff_t first = 0;
    for (const std::size_t axis : layout.Order)
    {
      const auto size = static_cast<std::ptrdiff_t>(box[axis].Size);
      first += layout.IsReversed[axis] ? stride * (size - 1) : 0;
      m_Axes[axis] = { box[axis].First, box[axis].Size, layout.IsReversed[axis] ? -stride : stride };
      stride = stride * size + layout.Free[axis];
    }
    m_First = first;
    m_Memory.assign(static_cast<std::size_t>(stride) * SizeOf(type), Untouched);
  }

  TestArray(const ElementType type, const Box & box)
    : TestArray(type, box, TestLayout::Dense(box.size()))
  {}

  itk::Subdivision::ArrayView
  View()
  {
    return { m_Memory.data() + m_First * static_cast<std::ptrdiff_t>(SizeOf(m_Type)), m_Type, m_Axes };
  }

  itk::Subdivision::ConstArrayView
  View() const
  {
    return { m_Memory.data() + m_First * static_cast<std::ptrdiff_t>(SizeOf(m_Type)), m_Type, m_Axes };
  }

  Box
  GetBox() const
  {
    return View().GetBox();
  }

  ElementType
  GetType() const
  {
    return m_Type;
  }

  double
  Get(const Index & index) const
  {
    return itk::Subdivision::WithElementType(m_Type, [&](const auto tag) {
      typename decltype(tag)::Type element;
      std::memcpy(&element, m_Memory.data() + Position(index), sizeof(element));
      return static_cast<double>(element);
    });
  }

  void
  Set(const Index & index, const double value)
  {
    itk::Subdivision::WithElementType(m_Type, [&](const auto tag) {
      const auto element = static_cast<typename decltype(tag)::Type>(value);
      std::memcpy(m_Memory.data() + Position(index), &element, sizeof(element));
    });
  }

  /** An element as it is; \c T must be the array's type. */
  template <typename T>
  T
  GetElement(const Index & index) const
  {
    T element;
    std::memcpy(&element, m_Memory.data() + Position(index), sizeof(element));
    return element;
  }

  template <typename T>
  void
  SetElement(const Index & index, const T element)
  {
    std::memcpy(m_Memory.data() + Position(index), &element, sizeof(element));
  }

  /** The bytes of some elements side by side. */
  std::vector<unsigned char>
  GetBytes(const Index & index, const std::size_t elements = 1) const
  {
    const auto begin = m_Memory.begin() + static_cast<std::ptrdiff_t>(Position(index));
    return { begin, begin + static_cast<std::ptrdiff_t>(elements * SizeOf(m_Type)) };
  }

  /** How many bytes of the memory have their first value. */
  std::size_t
  CountUntouched() const
  {
    return static_cast<std::size_t>(std::count(m_Memory.begin(), m_Memory.end(), Untouched));
  }

  /** Calls \c visit with every index of a box, the first axis running fastest. */
  template <typename TVisitor>
  static void
  ForEachIndex(const Box & box, const TVisitor & visit)
  {
    std::uint64_t count = 1;
    for (const auto & interval : box)
    {
      count *= interval.Size;
    }
    Index index(box.size());
    for (std::uint64_t number = 0; number < count; ++number)
    {
      std::uint64_t rest = number;
      for (std::size_t axis = 0; axis < box.size(); ++axis)
      {
        index[axis] = box[axis].First + static_cast<std::int64_t>(rest % box[axis].Size);
        rest /= box[axis].Size;
      }
      visit(std::as_const(index));
    }
  }

private:
  static constexpr unsigned char Untouched = 0xAB;

  std::size_t
  Position(const Index & index) const
  {
    std::ptrdiff_t position = m_First;
    for (std::size_t axis = 0; axis < index.size(); ++axis)
    {
      position += (index[axis] - m_Axes[axis].First) * m_Axes[axis].Stride;
    }
    return static_cast<std::size_t>(position) * SizeOf(m_Type);
  }

  ElementType                              m_Type;
  std::vector<itk::Subdivision::ArrayAxis> m_Axes;
  std::ptrdiff_t                           m_First;
  std::vector<unsigned char>               m_Memory;
};

#endif
