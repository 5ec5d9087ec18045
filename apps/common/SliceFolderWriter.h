// SPDX-License-Identifier: Apache-2.0
#ifndef SliceFolderWriter_h
#define SliceFolderWriter_h

#include "VolumeWriter.h"

#include <memory>
#include <string>

/** A writer of a folder of TIFF slices, NAME_0.tif and on, with zeros before the numbers, where NAME is the folder's.
 * The folder is complete or not there. One that exists gives way if it is empty or holds such slices alone. */
std::unique_ptr<VolumeWriter>
CreateSliceFolder(const std::string & path, const OutputOptions & options, const WarningSink & warn);

#endif
