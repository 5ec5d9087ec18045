// SPDX-License-Identifier: Apache-2.0
#include "system/process/PageBuffer.h"

#include <new>
#include <utility>

#include <sys/mman.h>

PageBuffer::~PageBuffer() { this->Release(); }

PageBuffer::PageBuffer(PageBuffer && other) noexcept
  : m_Data(std::exchange(other.m_Data, nullptr))
  , m_Bytes(std::exchange(other.m_Bytes, 0))
{}

PageBuffer &
PageBuffer::operator=(PageBuffer && other) noexcept
{
  std::swap(m_Data, other.m_Data);
  std::swap(m_Bytes, other.m_Bytes);
  return *this;
}

void
PageBuffer::Reserve(const std::size_t bytes)
{
  if (bytes <= m_Bytes)
  {
    return;
  }
  this->Release();
  void * const data = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (data == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
  m_Data = data;
  m_Bytes = bytes;
#ifdef MADV_HUGEPAGE
  madvise(data, bytes, MADV_HUGEPAGE);
#endif
}

void
PageBuffer::Release()
{
  if (m_Data != nullptr)
  {
    munmap(m_Data, m_Bytes);
    m_Data = nullptr;
    m_Bytes = 0;
  }
}
