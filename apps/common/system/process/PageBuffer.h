// SPDX-License-Identifier: Apache-2.0
#ifndef PageBuffer_h
#define PageBuffer_h

#include <cstddef>

/** Memory straight from the system, in huge pages where it has them, which it hands out several times as fast. It goes
 * back when the buffer does: an allocator might keep it, and a budget could not be kept. */
class PageBuffer
{
public:
  PageBuffer() = default;
  ~PageBuffer();
  PageBuffer(PageBuffer && other) noexcept;
  PageBuffer &
  operator=(PageBuffer && other) noexcept;

  /** Makes room for so many bytes; the contents are lost where that takes more memory.
   * \throw std::bad_alloc */
  void
  Reserve(std::size_t bytes);

  void *
  GetData() const
  {
    return m_Data;
  }

private:
  void
  Release();

  void *      m_Data = nullptr;
  std::size_t m_Bytes = 0;
};

#endif
