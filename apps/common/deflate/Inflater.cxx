// SPDX-License-Identifier: Apache-2.0
#include "deflate/Inflater.h"

#include <algorithm>
#include <new>

#include <zlib.h>
#ifdef APPS_HAVE_ISAL
#  include <isa-l/igzip_lib.h>
#endif

/** Decompresses from one range of bytes to another, and says how many bytes are left of both. */
class Inflater::Engine
{
public:
  virtual ~Engine() = default;
  virtual Status
  Inflate(unsigned char * in, unsigned int & available, unsigned char * out, unsigned int & room) = 0;
};

namespace
{
constexpr std::size_t Most = std::size_t{ 1 } << 30; // the libraries count with 32 bits
}

class Inflater::ZlibEngine : public Engine
{
public:
  explicit ZlibEngine(bool isGzip)
  {
    if (inflateInit2(&m_Stream, isGzip ? 16 + MAX_WBITS : MAX_WBITS) != Z_OK)
    {
      throw std::bad_alloc();
    }
  }
  ~ZlibEngine() override { inflateEnd(&m_Stream); }
  ZlibEngine(const ZlibEngine &) = delete;
  ZlibEngine &
  operator=(const ZlibEngine &) = delete;

  Status
  Inflate(unsigned char * in, unsigned int & available, unsigned char * out, unsigned int & room) override
  {
    m_Stream.next_in = in;
    m_Stream.avail_in = available;
    m_Stream.next_out = out;
    m_Stream.avail_out = room;
    const int result = inflate(&m_Stream, Z_NO_FLUSH);
    available = m_Stream.avail_in;
    room = m_Stream.avail_out;
    return result == Z_STREAM_END                    ? Status::Ended
           : result == Z_OK || result == Z_BUF_ERROR ? Status::Unfinished
                                                     : Status::Damaged;
  }

private:
  z_stream m_Stream = {};
};

#ifdef APPS_HAVE_ISAL
class Inflater::IsalEngine : public Engine
{
public:
  IsalEngine()
  {
    isal_inflate_init(&m_Stream);
    m_Stream.crc_flag = ISAL_GZIP;
  }

  Status
  Inflate(unsigned char * in, unsigned int & available, unsigned char * out, unsigned int & room) override
  {
    m_Stream.next_in = in;
    m_Stream.avail_in = available;
    m_Stream.next_out = out;
    m_Stream.avail_out = room;
    const int result = isal_inflate(&m_Stream);
    available = m_Stream.avail_in;
    room = m_Stream.avail_out;
    // A result above zero wants a dictionary, which no file has.
    return result != ISAL_DECOMP_OK                    ? Status::Damaged
           : m_Stream.block_state == ISAL_BLOCK_FINISH ? Status::Ended
                                                       : Status::Unfinished;
  }

private:
  inflate_state m_Stream = {};
};
#endif

// ISA-L 2.30 finds a wrong checksum where a zlib stream is taken in several parts.
Inflater::Inflater(bool isGzip)
{
#ifdef APPS_HAVE_ISAL
  if (isGzip)
  {
    m_Engine = std::make_unique<IsalEngine>();
    return;
  }
#endif
  m_Engine = std::make_unique<ZlibEngine>(isGzip);
}

Inflater::~Inflater() = default;

Inflater::Status
Inflater::Inflate(const unsigned char *& in, std::size_t & available, unsigned char *& out, std::size_t & room)
{
  const auto   given = static_cast<unsigned int>(std::min(available, Most));
  const auto   free = static_cast<unsigned int>(std::min(room, Most));
  unsigned int left = given;
  unsigned int empty = free;
  // Neither library writes to the input.
  const Status status = m_Engine->Inflate(const_cast<unsigned char *>(in), left, out, empty);
  in += given - left;
  available -= given - left;
  out += free - empty;
  room -= free - empty;
  return status;
}
