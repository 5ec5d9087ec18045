// SPDX-License-Identifier: Apache-2.0
#ifndef SliceFolder_h
#define SliceFolder_h

#include "volumes/VolumeReader.h"

#include <memory>
#include <string>

/** Whether a folder holds files that are named as TIFF, PNG, BMP or JPEG slices. */
bool
HoldsSlices(const std::string & path);

/** Opens a folder of TIFF, PNG, BMP or JPEG slices, numbered in their names. Each is opened when a part of it is read.
 * \throw std::runtime_error if the slices make no volume: the message names the odd one */
std::unique_ptr<VolumeReader>
OpenSliceFolder(const std::string & path, const InputOptions & options, const WarningSink & warn);

#endif
