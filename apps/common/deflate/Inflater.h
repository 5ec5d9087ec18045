// SPDX-License-Identifier: Apache-2.0
#ifndef Inflater_h
#define Inflater_h

#include <cstddef>
#include <memory>

/** Decompresses one zlib or gzip stream from memory to memory, gzip by ISA-L where it is at hand, else by
 * zlib. */
class Inflater
{
public:
  enum class Status
  {
    Unfinished,
    Ended, // and the checksum is right
    Damaged
  };

  explicit Inflater(bool isGzip);
  ~Inflater();

  /** Reads from a range of bytes and writes to another; both shrink by what was read and written. */
  Status
  Inflate(const unsigned char *& in, std::size_t & available, unsigned char *& out, std::size_t & room);

private:
  class Engine;
  class ZlibEngine;
  class IsalEngine;

  std::unique_ptr<Engine> m_Engine;
};

#endif
