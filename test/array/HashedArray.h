// SPDX-License-Identifier: Apache-2.0
#ifndef HashedArray_h
#define HashedArray_h

#include "NonOscillatorySubdivision/ArrayView.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

/** A dense array, and a hash of its bytes the way they lie on a little-endian machine. */
class HashedArray
{
public:
  HashedArray(const itk::Subdivision::ElementType type, const itk::Subdivision::Box & box)
    : m_Type(type)
    , m_Box(box)
    , m_Count(1)
  {
    for (const itk::Subdivision::Interval & interval : box)
    {
      m_Count *= interval.Size;
    }
    m_Memory.resize(m_Count * itk::Subdivision::SizeOf(type));
  }

  template <typename TFunction>
  void
  Fill(const TFunction & value)
  {
    itk::Subdivision::WithElementType(m_Type, [&](const auto tag) {
      using Element = typename decltype(tag)::Type;
      for (std::size_t i = 0; i < m_Count; ++i)
      {
        const auto element = static_cast<Element>(value(i));
        std::memcpy(m_Memory.data() + i * sizeof(Element), &element, sizeof(Element));
      }
    });
  }

  itk::Subdivision::ArrayView
  View()
  {
    itk::Subdivision::ArrayView view{ m_Memory.data(), m_Type, {} };
    std::ptrdiff_t              stride = 1;
    for (const itk::Subdivision::Interval & interval : m_Box)
    {
      view.Axes.push_back({ interval.First, interval.Size, stride });
      stride *= static_cast<std::ptrdiff_t>(interval.Size);
    }
    return view;
  }

  itk::Subdivision::ConstArrayView
  ConstView()
  {
    const itk::Subdivision::ArrayView view = this->View();
    return { view.Data, view.Type, view.Axes };
  }

  /** FNV-1a, of what was hashed before and of these elements. */
  std::uint64_t
  Hash(std::uint64_t hash) const
  {
    const std::uint16_t one = 1;
    unsigned char       firstByte;
    std::memcpy(&firstByte, &one, 1);
    const std::size_t size = itk::Subdivision::SizeOf(m_Type);
    for (std::size_t i = 0; i < m_Memory.size(); ++i)
    {
      const std::size_t byte = firstByte == 1 ? i : i - i % size + (size - 1 - i % size);
      hash = (hash ^ m_Memory[byte]) * 1099511628211u;
    }
    return hash;
  }

private:
  itk::Subdivision::ElementType m_Type;
  itk::Subdivision::Box         m_Box;
  std::size_t                   m_Count;
  std::vector<unsigned char>    m_Memory;
};

#endif
