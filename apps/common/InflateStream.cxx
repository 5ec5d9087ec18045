// SPDX-License-Identifier: Apache-2.0
#include "InflateStream.h"

#include <algorithm>
#include <new>
#include <stdexcept>

#include <zlib.h>

struct InflateStream::State
{
  State()
  {
    constexpr int anyHeader = 32 + MAX_WBITS;
    if (inflateInit2(&Stream, anyHeader) != Z_OK)
    {
      throw std::bad_alloc();
    }
  }
  ~State() { inflateEnd(&Stream); }
  State(const State &) = delete;
  State &
  operator=(const State &) = delete;

  z_stream Stream = {};
  bool     HasEnded = false;
};

InflateStream::InflateStream(const FileSection & section)
  : m_Section(section)
  , m_File(section.Path)
  , m_Compressed(ScratchBytes / 2)
{
  this->Restart();
}

InflateStream::~InflateStream() = default;

void
InflateStream::Restart()
{
  m_State = std::make_unique<State>();
  m_CompressedPosition = 0;
  m_Position = 0;
}

bool
InflateStream::Fill()
{
  const std::uint64_t count = std::min<std::uint64_t>(m_Compressed.size(), m_Section.Size - m_CompressedPosition);
  m_File.ReadAt(m_Section.Offset + m_CompressedPosition, m_Compressed.data(), count);
  m_CompressedPosition += count;
  m_State->Stream.next_in = reinterpret_cast<unsigned char *>(m_Compressed.data());
  m_State->Stream.avail_in = static_cast<unsigned int>(count);
  return count > 0;
}

std::uint64_t
InflateStream::ReadOn(char * bytes, std::uint64_t count)
{
  z_stream &    stream = m_State->Stream;
  std::uint64_t done = 0;
  while (done < count)
  {
    if (stream.avail_in == 0 && !this->Fill())
    {
      break;
    }
    if (m_State->HasEnded)
    {
      // A gzip file may be several streams, one after the other.
      if (stream.next_in[0] != 0x1f)
      {
        break;
      }
      inflateReset(&stream);
      m_State->HasEnded = false;
    }
    const auto part = static_cast<unsigned int>(std::min<std::uint64_t>(count - done, 1 << 30));
    stream.next_out = reinterpret_cast<unsigned char *>(bytes) + done;
    stream.avail_out = part;
    const int status = inflate(&stream, Z_NO_FLUSH);
    done += part - stream.avail_out;
    m_State->HasEnded = status == Z_STREAM_END;
    if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR)
    {
      break;
    }
  }
  m_Position += done;
  return done;
}

void
InflateStream::ReadAt(std::uint64_t offset, void * bytes, std::uint64_t count)
{
  if (offset < m_Position)
  {
    this->Restart();
  }
  std::vector<char> skipped(static_cast<std::size_t>(std::min<std::uint64_t>(offset - m_Position, 1 << 18)));
  bool              isThere = true;
  while (isThere && m_Position < offset)
  {
    const std::uint64_t part = std::min<std::uint64_t>(skipped.size(), offset - m_Position);
    isThere = this->ReadOn(skipped.data(), part) == part;
  }
  if (!isThere || this->ReadOn(static_cast<char *>(bytes), count) != count)
  {
    throw std::runtime_error("cannot read " + m_Section.Path + ": its compressed data is truncated or damaged");
  }
}

void
InflateStream::CheckEnd()
{
  char one = 0;
  if (this->ReadOn(&one, 1) != 0)
  {
    throw std::runtime_error("cannot read " + m_Section.Path +
                             ": it holds more data than its header says; the size or the type there is wrong");
  }
  if (!m_State->HasEnded)
  {
    throw std::runtime_error("cannot read " + m_Section.Path + ": its compressed data is truncated or damaged");
  }
}
