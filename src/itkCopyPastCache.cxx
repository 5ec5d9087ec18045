// SPDX-License-Identifier: Apache-2.0
#include "itkCopyPastCache.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__) || defined(_M_X64)
#  include <emmintrin.h>
#  define SUBDIVISION_HAS_SSE2
#endif

namespace itk
{

void
CopyPastCache(const void * from, std::size_t bytes, void * to)
{
#ifdef SUBDIVISION_HAS_SSE2
  constexpr std::size_t line = 64;
  const auto *          in = static_cast<const unsigned char *>(from);
  auto *                out = static_cast<unsigned char *>(to);
  const std::size_t     head = std::min(bytes, (line - reinterpret_cast<std::uintptr_t>(to) % line) % line);
  std::memcpy(out, in, head);
  std::size_t i = head;
  for (; i + line <= bytes; i += line)
  {
    for (std::size_t part = i; part < i + line; part += sizeof(__m128i))
    {
      const __m128i value = _mm_loadu_si128(reinterpret_cast<const __m128i *>(in + part));
      _mm_stream_si128(reinterpret_cast<__m128i *>(out + part), value);
    }
  }
  std::memcpy(out + i, in + i, bytes - i);
#else
  std::memcpy(to, from, bytes);
#endif
}

void
FinishCopiesPastCache()
{
#ifdef SUBDIVISION_HAS_SSE2
  _mm_sfence();
#endif
}

} // namespace itk
