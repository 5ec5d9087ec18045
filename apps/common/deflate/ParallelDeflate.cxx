// SPDX-License-Identifier: Apache-2.0
#include "deflate/ParallelDeflate.h"
#include "deflate/DeflateBlock.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <exception>
#include <thread>

#include <zlib.h>

namespace
{
constexpr std::size_t BlockSize = 1 << 20;
constexpr std::size_t DictionarySize = 1 << 15;
constexpr std::size_t BlocksPerThread = 2;

template <std::size_t VCount>
std::array<unsigned char, VCount>
ToBytes(std::uint64_t value, bool isBigEndian)
{
  std::array<unsigned char, VCount> bytes{};
  for (std::size_t i = 0; i < VCount; ++i)
  {
    bytes[isBigEndian ? VCount - 1 - i : i] = static_cast<unsigned char>(value >> (8 * i));
  }
  return bytes;
}
} // namespace

/** One block on its way into the stream. */
struct ParallelDeflate::Block
{
  const char *      Dictionary;
  std::size_t       DictionarySize;
  const char *      Bytes;
  std::size_t       Size;
  bool              IsLast;
  std::vector<char> Compressed;
  std::uint32_t     Checksum = 0;

  void
  Compress(Wrapper wrapper, int level)
  {
    Compressed = DeflateBlock(Dictionary, DictionarySize, Bytes, Size, IsLast, level);
    const auto * const data = reinterpret_cast<const unsigned char *>(Bytes);
    Checksum = static_cast<std::uint32_t>(wrapper == Wrapper::Gzip ? crc32_z(0, data, Size) : adler32_z(1, data, Size));
  }
};

ParallelDeflate::ParallelDeflate(Wrapper wrapper, int level, unsigned int threads, Sink sink)
  : m_Wrapper(wrapper)
  , m_Level(level >= 1 && level <= 9 ? level : 2)
  , m_Threads(std::max(threads, 1u))
  , m_Sink(std::move(sink))
  , m_Checksum(wrapper == Wrapper::Gzip ? 0 : 1)
{
  if (wrapper == Wrapper::Gzip)
  {
    constexpr unsigned char header[] = { 0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 0xff }; // no name, no time, any system
    m_Sink(header, sizeof(header));
  }
  else
  {
    constexpr unsigned char header[] = { 0x78, 0x5e }; // a window of 32 KiB, no preset dictionary
    m_Sink(header, sizeof(header));
  }
}

std::uint64_t
ParallelDeflate::GetScratchBytes(unsigned int threads)
{
  constexpr std::uint64_t perBlock = 2 * BlockSize + BlockSize / 4; // in, out, and a compressor's tables
  return std::max(threads, 1u) * BlocksPerThread * perBlock + 2 * DictionarySize;
}

void
ParallelDeflate::Write(const void * bytes, std::size_t count)
{
  const std::size_t batch = m_Threads * BlocksPerThread * BlockSize;
  const char *      next = static_cast<const char *>(bytes);
  while (count > 0)
  {
    const std::size_t part = std::min(count, batch - (m_Bytes.size() - m_DictionarySize));
    m_Bytes.insert(m_Bytes.end(), next, next + part);
    next += part;
    count -= part;
    // The last block is known to be the last one only in Finish(): a full batch waits until more comes.
    if (count > 0)
    {
      this->CompressPending(false);
    }
  }
}

void
ParallelDeflate::CompressPending(bool isLast)
{
  std::vector<Block> blocks;
  for (std::size_t place = m_DictionarySize; place < m_Bytes.size() || (isLast && blocks.empty());)
  {
    const std::size_t size = std::min(BlockSize, m_Bytes.size() - place);
    const std::size_t dictionary = std::min(place, DictionarySize);
    const char *      first = m_Bytes.data() + place;
    blocks.push_back({ first - dictionary, dictionary, first, size, isLast && place + size == m_Bytes.size(), {}, 0 });
    place += size;
  }

  std::atomic<std::size_t>        next{ 0 };
  std::vector<std::exception_ptr> errors(m_Threads);
  const auto                      work = [&](std::size_t thread) {
    try
    {
      for (std::size_t i = next++; i < blocks.size(); i = next++)
      {
        blocks[i].Compress(m_Wrapper, m_Level);
      }
    }
    catch (...)
    {
      errors[thread] = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t thread = 1; thread < std::min<std::size_t>(m_Threads, blocks.size()); ++thread)
  {
    threads.emplace_back(work, thread);
  }
  work(0);
  for (std::thread & thread : threads)
  {
    thread.join();
  }
  for (const std::exception_ptr & error : errors)
  {
    if (error != nullptr)
    {
      std::rethrow_exception(error);
    }
  }

  for (const Block & block : blocks)
  {
    m_Sink(block.Compressed.data(), block.Compressed.size());
    const auto size = static_cast<z_off_t>(block.Size);
    m_Checksum =
      static_cast<std::uint32_t>(m_Wrapper == Wrapper::Gzip ? crc32_combine(m_Checksum, block.Checksum, size)
                                                            : adler32_combine(m_Checksum, block.Checksum, size));
    m_Size += block.Size;
  }
  m_DictionarySize = std::min(m_Bytes.size(), DictionarySize);
  m_Bytes.erase(m_Bytes.begin(), m_Bytes.end() - static_cast<std::ptrdiff_t>(m_DictionarySize));
}

void
ParallelDeflate::Finish()
{
  this->CompressPending(true);
  const bool isGzip = m_Wrapper == Wrapper::Gzip;
  const auto checksum = ToBytes<4>(m_Checksum, !isGzip);
  m_Sink(checksum.data(), checksum.size());
  if (isGzip)
  {
    const auto size = ToBytes<4>(m_Size, false);
    m_Sink(size.data(), size.size());
  }
}
