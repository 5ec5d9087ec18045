// SPDX-License-Identifier: Apache-2.0
#ifndef MetaHeader_h
#define MetaHeader_h

#include "headers/Metadata.h"
#include "headers/PlainLayout.h"

#include <string>

/** Reads the header of a MetaImage (.mha, .mhd) and finds its voxels.
 * \throw HeaderNotUnderstood if the image is none of those whose voxels simply stand in files
 * \throw std::runtime_error if the header or the files are not right */
PlainLayout
ReadMetaHeader(const std::string & path);

/** A header up to the name of the data file, that name included. With compressed voxels, FillInCompressedSize()
 * completes it.
 * \param dataFile its name, or LOCAL */
std::string
ComposeMetaHeader(const ImageDescription & description,
                  const OutputMetadata &   metadata,
                  const std::string &      dataFile,
                  bool                     isCompressed);

/** Fills the number of bytes into a header for compressed voxels, whose length stays the same. */
void
FillInCompressedSize(std::string & header, std::uint64_t size);

#endif
