// SPDX-License-Identifier: Apache-2.0
#ifndef DeflateBlock_h
#define DeflateBlock_h

#include <cstddef>
#include <vector>

/** A block of a deflate stream without a wrapper. Unless it is the last one, it ends at a byte's border, so that the
 * next one can follow it.
 * \param dictionary the bytes before the block
 * \param level 1 to 9 */
std::vector<char>
DeflateBlock(const char * dictionary,
             std::size_t  dictionarySize,
             const char * bytes,
             std::size_t  size,
             bool         isLast,
             int          level);

#endif
