// SPDX-License-Identifier: Apache-2.0
#include "deflate/ParallelDeflate.h"

#include "TestFolder.h"
#include "deflate/DeflateBlock.h"
#include "deflate/InflateStream.h"

#include <gtest/gtest.h>

#include <string>

#include <zlib.h>

namespace
{
using Wrapper = ParallelDeflate::Wrapper;

std::string
Compress(const std::string & bytes, Wrapper wrapper, int level, unsigned int threads, std::size_t part)
{
  std::string     stream;
  ParallelDeflate deflate(wrapper, level, threads, [&](const void * piece, std::size_t count) {
    stream.append(static_cast<const char *>(piece), count);
  });
  for (std::size_t i = 0; i < bytes.size(); i += part)
  {
    deflate.Write(bytes.data() + i, std::min(part, bytes.size() - i));
  }
  deflate.Finish();
  return stream;
}

/** By zlib alone, which checks the checksum: one stream and nothing after it. */
std::string
Inflate(std::string stream, std::size_t size, Wrapper wrapper)
{
  std::string bytes(size + 1, '\0');
  z_stream    state = {};
  inflateInit2(&state, wrapper == Wrapper::Gzip ? 16 + MAX_WBITS : MAX_WBITS);
  state.next_in = reinterpret_cast<unsigned char *>(stream.data());
  state.avail_in = static_cast<unsigned int>(stream.size());
  state.next_out = reinterpret_cast<unsigned char *>(bytes.data());
  state.avail_out = static_cast<unsigned int>(bytes.size());
  EXPECT_EQ(inflate(&state, Z_FINISH), Z_STREAM_END);
  EXPECT_EQ(state.avail_in, 0u);
  bytes.resize(bytes.size() - state.avail_out);
  inflateEnd(&state);
  return bytes;
}

/** Words that repeat, noise that does not compress at all, and zeros. */
std::string
MakeBytes(std::size_t size)
{
  std::string   bytes;
  std::uint32_t state = 7;
  while (bytes.size() < size)
  {
    state = state * 1664525u + 1013904223u;
    const bool isNoise = bytes.size() / 300000 % 3 == 1;
    const bool isZero = bytes.size() / 300000 % 3 == 2;
    bytes += isZero    ? std::string(50, '\0')
             : isNoise ? std::string(1, static_cast<char>(state >> 24))
                       : "voxel " + std::to_string(state >> 20) + " ";
  }
  bytes.resize(size);
  return bytes;
}
} // namespace

TEST(ParallelDeflate, IsOneValidStreamAtEverySizeAndLevel)
{
  for (const std::size_t size : { std::size_t{ 0 },
                                  std::size_t{ 1 },
                                  std::size_t{ 1 } << 20,
                                  (std::size_t{ 1 } << 20) + 1,
                                  std::size_t{ 2500000 } })
  {
    const std::string bytes = MakeBytes(size);
    for (const Wrapper wrapper : { Wrapper::Zlib, Wrapper::Gzip })
    {
      for (const int level : { 1, 2, 5, 9 })
      {
        const std::string stream = Compress(bytes, wrapper, level, 2, size + 1);
        EXPECT_TRUE(Inflate(stream, size, wrapper) == bytes) << size << " bytes at level " << level;
        EXPECT_LT(stream.size(), size * 8 / 10 + 100);
      }
    }
  }
}

TEST(ParallelDeflate, ThreadsAndPartsMakeNoDifference)
{
  const std::string bytes = MakeBytes(9000000);
  const std::string expected = Compress(bytes, Wrapper::Gzip, -1, 1, bytes.size());
  EXPECT_TRUE(Compress(bytes, Wrapper::Gzip, -1, 5, 1000003) == expected);
  EXPECT_TRUE(Compress(bytes, Wrapper::Gzip, -1, 2, 1 << 20) == expected);
  EXPECT_TRUE(Compress(bytes, Wrapper::Gzip, -1, 3, 4099) == expected);
}

TEST(DeflateBlock, UsesItsDictionary)
{
  const std::string noise = MakeBytes(600000).substr(400000, 8000);
  for (int level = 1; level <= 9; ++level)
  {
    const auto compressed = DeflateBlock(noise.data(), noise.size(), noise.data(), noise.size(), true, level);
    EXPECT_LT(compressed.size(), 800u) << "level " << level;
  }
}

TEST(InflateStream, ReadsForwardAndBack)
{
  const TestFolder  folder;
  const std::string bytes = MakeBytes(3000000);
  const std::string stream = Compress(bytes, Wrapper::Gzip, 6, 2, bytes.size());
  folder.WriteFile("stream", "before" + stream + "after");
  InflateStream inflate({ folder / "stream", 6, stream.size() });
  for (const std::size_t offset : { std::size_t{ 10 }, std::size_t{ 2000000 }, std::size_t{ 500 } })
  {
    std::string part(1000, '\0');
    inflate.ReadAt(offset, part.data(), part.size());
    EXPECT_EQ(part, bytes.substr(offset, part.size()));
  }
  EXPECT_THROW(inflate.CheckEnd(), std::runtime_error); // there is more
  std::string rest(bytes.size() - 1500, '\0');
  inflate.ReadAt(1500, rest.data(), rest.size());
  EXPECT_NO_THROW(inflate.CheckEnd());
}

// A gzip file of several streams counts as one.
TEST(InflateStream, ReadsOneStreamAfterAnother)
{
  const TestFolder  folder;
  const auto        make = [](const std::string & bytes) { return Compress(bytes, Wrapper::Gzip, 2, 1, 100); };
  const std::string stream = make("one ") + make("two ") + make("three");
  folder.WriteFile("stream", stream);
  InflateStream inflate({ folder / "stream", 0, stream.size() });
  std::string   text(13, '\0');
  inflate.ReadAt(0, text.data(), text.size());
  EXPECT_EQ(text, "one two three");
  EXPECT_NO_THROW(inflate.CheckEnd());
}

TEST(InflateStream, NoticesEveryDamage)
{
  const TestFolder  folder;
  const std::string bytes = MakeBytes(2000);
  for (const Wrapper wrapper : { Wrapper::Zlib, Wrapper::Gzip })
  {
    const std::string stream = Compress(bytes, wrapper, 6, 1, bytes.size());
    const auto        isRead = [&](const std::string & damaged) {
      folder.WriteFile("stream", damaged);
      std::string found(bytes.size(), '\0');
      try
      {
        InflateStream inflate({ folder / "stream", 0, damaged.size() });
        inflate.ReadAt(0, found.data(), found.size());
        inflate.CheckEnd();
      }
      catch (const std::runtime_error &)
      {
        return false;
      }
      EXPECT_EQ(found, bytes);
      return true;
    };
    ASSERT_TRUE(isRead(stream));
    for (std::size_t size = 0; size < stream.size(); size += 7)
    {
      EXPECT_FALSE(isRead(stream.substr(0, size))) << "cut at " << size;
    }
    EXPECT_FALSE(isRead(stream.substr(0, stream.size() - 1)));
    for (std::size_t i = wrapper == Wrapper::Gzip ? 10 : 2; i < stream.size(); i += 5)
    {
      std::string damaged = stream;
      damaged[i] = static_cast<char>(damaged[i] ^ 4);
      EXPECT_FALSE(isRead(damaged)) << "byte " << i;
    }
  }
}
