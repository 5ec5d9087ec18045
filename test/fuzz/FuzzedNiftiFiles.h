// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzedNiftiFiles_h
#define FuzzedNiftiFiles_h

#include "FuzzBytes.h"
#include "FuzzFolder.h"

#include <optional>
#include <string>

/** The files of an image, as they are without compression. */
struct FuzzedNiftiFiles
{
  std::string Path; // by which it is opened
  bool        IsPair = false;
  bool        HasPlainVoxels = true;
  std::string HeaderText;
  std::string Voxels; // with what precedes them in their file
};

/** Writes a single file or a pair, each compressed or not, opened by the name of either.
 * \return nothing for a stream of gzip that is not one whole one */
std::optional<FuzzedNiftiFiles>
MakeNiftiFiles(FuzzBytes & bytes, const FuzzFolder & folder);

#endif
