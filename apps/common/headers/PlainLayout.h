// SPDX-License-Identifier: Apache-2.0
#ifndef PlainLayout_h
#define PlainLayout_h

#include "system/files/FileSection.h"
#include "volumes/ImageDescription.h"

#include <cstdint>
#include <vector>

/** How voxels stand in a file: as they are, compressed (zlib or gzip, as the first bytes tell), or as text, as numbers
 * or as the hexadecimal digits of their bytes. */
enum class PlainEncoding
{
  Raw,
  Compressed,
  Text,
  Hex
};

/** Where the voxels of an image stand behind a text header: x fastest, one part after the other. */
struct PlainLayout
{
  ImageDescription         Description;
  std::vector<FileSection> Sections; // of the voxels as they stand, each of as many; a compressed stream is one
  PlainEncoding            Encoding = PlainEncoding::Raw;
  std::uint64_t            InflatedOffset = 0; // bytes of the decompressed stream before the voxels
  bool                     IsBigEndian = false;
};

#endif
