// SPDX-License-Identifier: Apache-2.0
#ifndef PlainLayout_h
#define PlainLayout_h

#include "system/files/FileSection.h"
#include "volumes/ImageDescription.h"

#include <cstdint>
#include <vector>

/** Where the voxels of an image stand behind a text header: x fastest, one part after the other. */
struct PlainLayout
{
  ImageDescription         Description;
  std::vector<FileSection> Sections;             // of the voxels' bytes, or the only one of their compressed stream
  bool                     IsCompressed = false; // zlib or gzip, as its first bytes tell
  std::uint64_t            InflatedOffset = 0;   // bytes of the decompressed stream before the voxels
  bool                     IsBigEndian = false;
};

#endif
