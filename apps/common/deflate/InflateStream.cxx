// SPDX-License-Identifier: Apache-2.0
#include "deflate/InflateStream.h"

#include <algorithm>
#include <stdexcept>

InflateStream::InflateStream(const FileSection & section)
  : m_Section(section)
  , m_File(section.Path)
  , m_Compressed(ScratchBytes / 2)
{}

void
InflateStream::FailOfDamage() const
{
  throw std::runtime_error("cannot read " + m_Section.Path + ": its compressed data is truncated or damaged");
}

void
InflateStream::Restart()
{
  m_Inflater.reset();
  m_IsDamaged = false;
  m_Available = 0;
  m_CompressedPosition = 0;
  m_Position = 0;
}

bool
InflateStream::Fill()
{
  m_Available = std::min<std::uint64_t>(m_Compressed.size(), m_Section.Size - m_CompressedPosition);
  m_File.ReadAt(m_Section.Offset + m_CompressedPosition, m_Compressed.data(), m_Available);
  m_CompressedPosition += m_Available;
  m_Next = m_Compressed.data();
  return m_Available > 0;
}

std::uint64_t
InflateStream::ReadOn(char * bytes, std::uint64_t count)
{
  auto *      out = reinterpret_cast<unsigned char *>(bytes);
  std::size_t room = count;
  while (room > 0 && !m_IsDamaged && (m_Available > 0 || this->Fill()))
  {
    constexpr unsigned char gzip = 0x1f; // its first byte
    if (m_Inflater == nullptr)
    {
      // A gzip file may be several streams, one after the other.
      if (m_Position + (count - room) > 0 && *m_Next != gzip)
      {
        break;
      }
      m_Inflater = std::make_unique<Inflater>(*m_Next == gzip);
    }
    const auto status = m_Inflater->Inflate(m_Next, m_Available, out, room);
    m_IsDamaged = status == Inflater::Status::Damaged;
    if (status == Inflater::Status::Ended)
    {
      m_Inflater.reset();
    }
  }
  m_Position += count - room;
  return count - room;
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
    this->FailOfDamage();
  }
}

void
InflateStream::CheckEnd()
{
  char one = 0;
  if (this->ReadOn(&one, 1) != 0)
  {
    throw std::runtime_error("cannot read " + m_Section.Path +
                             ": its compressed data is damaged, or more than the size and type in its header say");
  }
  if (m_IsDamaged || m_Inflater != nullptr)
  {
    this->FailOfDamage();
  }
}

std::uint64_t
InflateStream::Measure()
{
  this->Restart();
  std::vector<char> bytes(1 << 18);
  while (this->ReadOn(bytes.data(), bytes.size()) == bytes.size())
  {
  }
  if (m_IsDamaged || m_Inflater != nullptr)
  {
    this->FailOfDamage();
  }
  return m_Position;
}
