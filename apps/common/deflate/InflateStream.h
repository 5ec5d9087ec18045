// SPDX-License-Identifier: Apache-2.0
#ifndef InflateStream_h
#define InflateStream_h

#include "deflate/Inflater.h"
#include "system/files/FileSection.h"
#include "system/files/InputFile.h"

#include <cstdint>
#include <memory>
#include <vector>

/** Reads a zlib or gzip stream in a file, forward; going back starts again. */
class InflateStream
{
public:
  static constexpr std::uint64_t ScratchBytes = 1 << 20;

  explicit InflateStream(const FileSection & section);

  /** Reads decompressed bytes.
   * \throw std::runtime_error if the stream is damaged or ends before */
  void
  ReadAt(std::uint64_t offset, void * bytes, std::uint64_t count);

  /** Checks that the stream ends where the last ReadAt() did, and that its checksum is that of all bytes.
   * \throw std::runtime_error */
  void
  CheckEnd();

  /** Decompresses all, and counts the bytes.
   * \throw std::runtime_error if the stream is damaged or breaks off */
  std::uint64_t
  Measure();

private:
  [[noreturn]] void
  FailOfDamage() const;
  void
  Restart();
  std::uint64_t
  ReadOn(char * bytes, std::uint64_t count);
  bool
  Fill();

  FileSection                m_Section;
  InputFile                  m_File;
  std::unique_ptr<Inflater>  m_Inflater; // null between streams
  bool                       m_IsDamaged = false;
  std::vector<unsigned char> m_Compressed;
  const unsigned char *      m_Next = nullptr; // of the compressed bytes in memory
  std::size_t                m_Available = 0;
  std::uint64_t              m_CompressedPosition = 0; // of what is read next, within the section
  std::uint64_t              m_Position = 0;           // among the decompressed bytes
};

#endif
