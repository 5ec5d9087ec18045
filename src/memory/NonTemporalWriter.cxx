// SPDX-License-Identifier: Apache-2.0
#include "memory/NonTemporalWriter.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__) || defined(_M_X64)
#  include <emmintrin.h>
#  define SUBDIVISION_HAS_SSE2
#endif

namespace itk
{
namespace Subdivision
{
namespace
{

/** Copies as many bytes as there are in some whole lines. */
void
CopyLines(const unsigned char * const from, const std::size_t bytes, unsigned char * const to)
{
#ifdef SUBDIVISION_HAS_SSE2
  constexpr std::size_t line = 4 * sizeof(__m128i);
  for (std::size_t i = 0; i < bytes; i += line)
  {
    const auto * const in = reinterpret_cast<const __m128i *>(from + i);
    auto * const       out = reinterpret_cast<__m128i *>(to + i);
    for (int part = 0; part < 4; ++part)
    {
      _mm_stream_si128(out + part, _mm_loadu_si128(in + part));
    }
  }
#else
  std::memcpy(to, from, bytes);
#endif
}

} // namespace

NonTemporalWriter::~NonTemporalWriter()
{
  this->CopyWaiting();
#ifdef SUBDIVISION_HAS_SSE2
  _mm_sfence();
#endif
}

void
NonTemporalWriter::Copy(const void * const from, const std::size_t bytes, void * const to)
{
  const auto * in = static_cast<const unsigned char *>(from);
  auto *       out = static_cast<unsigned char *>(to);
  if (out != m_End)
  {
    this->CopyWaiting();
  }
  m_End = out + bytes;

  const std::size_t begun = reinterpret_cast<std::uintptr_t>(out) % LineLength;
  const std::size_t head = std::min(bytes, (LineLength - begun) % LineLength);
  if (m_Waiting == 0)
  {
    // What the line begins with is somebody else's.
    std::memcpy(out, in, head);
  }
  else
  {
    std::memcpy(m_Line + begun, in, head);
    m_Waiting += head;
    if (m_Waiting == LineLength)
    {
      CopyLines(m_Line, LineLength, out - begun);
      m_Waiting = 0;
    }
  }
  const std::size_t lines = (bytes - head) / LineLength * LineLength;
  CopyLines(in + head, lines, out + head);

  const std::size_t tail = bytes - head - lines;
  std::memcpy(m_Line + m_Waiting, in + head + lines, tail);
  m_Waiting += tail;
}

void
NonTemporalWriter::CopyWaiting()
{
  if (m_Waiting > 0)
  {
    std::memcpy(m_End - m_Waiting, m_Line, m_Waiting);
    m_Waiting = 0;
  }
}

} // namespace Subdivision
} // namespace itk
