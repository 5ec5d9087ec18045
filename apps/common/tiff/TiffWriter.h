// SPDX-License-Identifier: Apache-2.0
#ifndef TiffWriter_h
#define TiffWriter_h

#include "volumes/VolumeWriter.h"

#include <memory>
#include <string>

/** A writer of a TIFF file with a page for each slice and ImageJ's description, which holds the spacing along z. Above
 * 4 GB it is a BigTIFF. */
std::unique_ptr<VolumeWriter>
CreateTiff(const std::string & path, const OutputOptions & options, const WarningSink & warn);

#endif
