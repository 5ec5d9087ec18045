// SPDX-License-Identifier: Apache-2.0
#ifndef RawReader_h
#define RawReader_h

#include "volumes/VolumeReader.h"

#include <memory>
#include <string>

/** Understands "1024x1024x800:uint16": sizes along x, y, z and t, and the type of the elements, followed by any of
 * ":big" for big-endian numbers, ":3" for voxels of three components, and "+512" for bytes before the voxels.
 * \throw std::invalid_argument that says in one line what is wrong */
RawLayout
ParseRawLayout(const std::string & text);

/** Opens a file of voxels alone, whose layout the options name.
 * \throw std::runtime_error if the file has not exactly the size that the layout has */
std::unique_ptr<VolumeReader>
OpenRaw(const std::string & path, const InputOptions & options, const WarningSink & warn);

#endif
