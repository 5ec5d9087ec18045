// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzBytes_h
#define FuzzBytes_h

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

/** What a fuzzer offers, as choices; zeros once it is used up. */
class FuzzBytes
{
public:
  FuzzBytes(const std::uint8_t * const data, const std::size_t size)
    : m_Next(data)
    , m_Size(size)
  {}

  std::uint8_t
  Byte()
  {
    if (m_Size == 0)
    {
      return 0;
    }
    --m_Size;
    return *m_Next++;
  }

  /** A number below another one, which is 256 at most. */
  unsigned int
  Below(const std::size_t number)
  {
    return static_cast<unsigned int>(this->Byte() % number);
  }

  /** A number from 0 to another one; of two bytes where a byte does not hold that. */
  std::uint64_t
  UpTo(const std::uint64_t last)
  {
    const std::uint64_t low = this->Byte();
    return (last < 256 ? low : low + 256u * this->Byte()) % (last + 1);
  }

  /** All that is left. */
  std::string
  Rest()
  {
    std::string text(reinterpret_cast<const char *>(m_Next), m_Size);
    m_Size = 0;
    return text;
  }

private:
  const std::uint8_t * m_Next;
  std::size_t          m_Size;
};

/** Ends the program, which is how a fuzzer learns of a fault. */
inline void
FuzzExpect(const bool isRight, const std::string & what)
{
  if (!isRight)
  {
    std::fprintf(stderr, "fault: %s\n", what.c_str());
    std::abort();
  }
}

/** The one function of a fuzzer, for libFuzzer and for Replay.cxx. */
extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size);

#endif
