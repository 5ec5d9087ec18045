// SPDX-License-Identifier: Apache-2.0
#ifndef CreateVolume_h
#define CreateVolume_h

#include "volumes/VolumeWriter.h"

#include <memory>
#include <string>

/** A writer for the format that the name's ending says, or for a folder of slices where the name is a folder's.
 * \throw std::runtime_error that lists the formats, if there is none for that ending */
std::unique_ptr<VolumeWriter>
CreateVolume(const std::string & path, const OutputOptions & options, const WarningSink & warn);

#endif
