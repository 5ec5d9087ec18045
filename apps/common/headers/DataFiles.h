// SPDX-License-Identifier: Apache-2.0
#ifndef DataFiles_h
#define DataFiles_h

#include "headers/PlainLayout.h"

#include <string>
#include <vector>

/** What a text header says of the files that hold the voxels. */
struct DataFiles
{
  std::vector<std::string> Names;              // as the header has them; empty: the header's own file
  std::uint64_t            HeaderEnd = 0;      // of the header's own file, where its data start
  std::uint64_t            LineSkip = 0;       // at the start of each data file
  std::int64_t             ByteSkip = 0;       // after the lines; -1: the voxels are the file's last bytes
  std::uint64_t            CompressedSize = 0; // if the header says so
};

/** Finds the voxels of a layout whose description, compression and byte order are known, and checks that the files hold
 * exactly as many as the header says. What a compressed stream holds shows only when it is read.
 * \throw std::runtime_error */
void
LocateData(const std::string & path, const DataFiles & files, PlainLayout & layout);

#endif
