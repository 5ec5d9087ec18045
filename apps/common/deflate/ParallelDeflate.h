// SPDX-License-Identifier: Apache-2.0
#ifndef ParallelDeflate_h
#define ParallelDeflate_h

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

/** Compresses bytes into one zlib or gzip stream, by several threads. Each block of 1 MiB is compressed for itself,
 * with the 32 KiB before it as its dictionary, so that the stream depends on the bytes and the level alone. */
class ParallelDeflate
{
public:
  enum class Wrapper
  {
    Zlib,
    Gzip
  };
  using Sink = std::function<void(const void *, std::size_t)>;

  /** \param level 1 (fast) to 9 (small); else the default, 2. Where ISA-L is at hand, 1 to 6 are its levels 1 to 3; 7
   * to 9 are zlib's.
   * \param sink takes the stream, piece by piece, in order, in the caller's thread */
  ParallelDeflate(Wrapper wrapper, int level, unsigned int threads, Sink sink);

  /** Bytes of memory that it needs. */
  static std::uint64_t
  GetScratchBytes(unsigned int threads);

  void
  Write(const void * bytes, std::size_t count);

  /** Compresses what is left and ends the stream. */
  void
  Finish();

private:
  struct Block;

  void
  CompressPending(bool isLast);

  Wrapper           m_Wrapper;
  int               m_Level;
  unsigned int      m_Threads;
  Sink              m_Sink;
  std::vector<char> m_Bytes; // the dictionary of the next block, and what was not compressed yet
  std::size_t       m_DictionarySize = 0;
  std::uint32_t     m_Checksum;
  std::uint64_t     m_Size = 0;
};

#endif
