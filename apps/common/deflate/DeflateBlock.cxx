// SPDX-License-Identifier: Apache-2.0
#include "deflate/DeflateBlock.h"

#include <new>
#include <stdexcept>

#include <zlib.h>
#ifdef APPS_HAVE_ISAL
#  include <isa-l/igzip_lib.h>
#endif

namespace
{
unsigned char *
AsUnsigned(const char * bytes)
{
  return reinterpret_cast<unsigned char *>(const_cast<char *>(bytes)); // neither library writes there
}

/** More than deflate's blocks, even stored ones, can take. */
std::size_t
GetBound(std::size_t size)
{
  return size + size / 1000 * 5 + 1024;
}

std::vector<char>
DeflateWithZlib(const char * dictionary,
                std::size_t  dictionarySize,
                const char * bytes,
                std::size_t  size,
                bool         isLast,
                int          level)
{
  z_stream stream = {};
  if (deflateInit2(&stream, level, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) != Z_OK)
  {
    throw std::bad_alloc();
  }
  if (dictionarySize > 0)
  {
    deflateSetDictionary(&stream, AsUnsigned(dictionary), static_cast<unsigned int>(dictionarySize));
  }
  std::vector<char> out(GetBound(size));
  stream.next_in = AsUnsigned(bytes);
  stream.avail_in = static_cast<unsigned int>(size);
  stream.next_out = AsUnsigned(out.data());
  stream.avail_out = static_cast<unsigned int>(out.size());
  const int status = deflate(&stream, isLast ? Z_FINISH : Z_SYNC_FLUSH);
  deflateEnd(&stream);
  if (status != (isLast ? Z_STREAM_END : Z_OK) || stream.avail_in != 0 || stream.avail_out == 0)
  {
    throw std::runtime_error("the compression of voxels failed");
  }
  out.resize(out.size() - stream.avail_out);
  return out;
}

#ifdef APPS_HAVE_ISAL
std::vector<char>
DeflateWithIsal(const char * dictionary,
                std::size_t  dictionarySize,
                const char * bytes,
                std::size_t  size,
                bool         isLast,
                int          level)
{
  constexpr std::size_t tableSizes[] = {
    ISAL_DEF_LVL0_DEFAULT, ISAL_DEF_LVL1_DEFAULT, ISAL_DEF_LVL2_DEFAULT, ISAL_DEF_LVL3_DEFAULT
  };
  std::vector<unsigned char> tables(tableSizes[level]);
  isal_zstream               stream;
  isal_deflate_init(&stream);
  stream.level = static_cast<unsigned int>(level);
  stream.level_buf = tables.data();
  stream.level_buf_size = static_cast<unsigned int>(tables.size());
  if (dictionarySize > 0)
  {
    isal_deflate_set_dict(&stream, AsUnsigned(dictionary), static_cast<unsigned int>(dictionarySize));
  }
  std::vector<char> out(GetBound(size));
  stream.next_in = AsUnsigned(bytes);
  stream.avail_in = static_cast<unsigned int>(size);
  stream.end_of_stream = isLast ? 1 : 0;
  stream.flush = isLast ? NO_FLUSH : SYNC_FLUSH;
  stream.next_out = AsUnsigned(out.data());
  stream.avail_out = static_cast<unsigned int>(out.size());
  if (isal_deflate(&stream) != COMP_OK || stream.avail_in != 0 || stream.avail_out == 0)
  {
    throw std::runtime_error("the compression of voxels failed");
  }
  out.resize(out.size() - stream.avail_out);
  return out;
}
#endif
} // namespace

std::vector<char>
DeflateBlock(const char * dictionary,
             std::size_t  dictionarySize,
             const char * bytes,
             std::size_t  size,
             bool         isLast,
             int          level)
{
#ifdef APPS_HAVE_ISAL
  if (level <= 6)
  {
    const int isalLevel = level == 1 ? 1 : level <= 4 ? 2 : 3;
    return DeflateWithIsal(dictionary, dictionarySize, bytes, size, isLast, isalLevel);
  }
#endif
  return DeflateWithZlib(dictionary, dictionarySize, bytes, size, isLast, level);
}
