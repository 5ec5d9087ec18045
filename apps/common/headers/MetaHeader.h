// SPDX-License-Identifier: Apache-2.0
#ifndef MetaHeader_h
#define MetaHeader_h

#include "headers/Metadata.h"
#include "headers/PlainLayout.h"

#include <string>

/** The number of bytes in a compressed stream.
 * \throw std::runtime_error if it is damaged */
using StreamMeasure = std::uint64_t (*)(const FileSection &);

/** Reads the header of a MetaImage (.mha, .mhd) and finds its voxels.
 * \param measure tells whether compressed MET_LONG and MET_ULONG have four bytes or eight
 * \throw std::runtime_error if the header or the files are not right */
PlainLayout
ReadMetaHeader(const std::string & path, StreamMeasure measure = nullptr);

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
