// SPDX-License-Identifier: Apache-2.0
#ifndef SliceFolderWriter_h
#define SliceFolderWriter_h

#include "volumes/VolumeWriter.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

/** A writer of a folder of TIFF slices, NAME_0.tif and on, with zeros before the numbers, where NAME is the folder's.
 * The folder is complete or not there. One that exists gives way if it is empty or holds such slices alone. */
std::unique_ptr<VolumeWriter>
CreateSliceFolder(const std::string & path, const OutputOptions & options, const WarningSink & warn);

/** The folder's path without a slash at its end, whose last part is its name. */
std::filesystem::path
GetSliceFolder(const std::string & path);

/** The name of a slice in its folder, of so many. */
std::string
GetSliceName(const std::filesystem::path & folder, std::uint64_t number, std::uint64_t slices);

/** Whether a slice may be too large for the addresses of a classic TIFF file. */
bool
NeedsBigTiff(const ImageDescription & description);

/** Copies the files that systems keep in folders of their own accord, such as .DS_Store, into the folder that replaces
 * another one.
 * \throw std::runtime_error */
void
KeepFilesOfSystems(const std::string & path, const std::filesystem::path & from, const std::filesystem::path & to);

/** What is not an output of before, nor a file that systems keep in folders of their own accord, stays; a name like
 * that of a slice does not make it one.
 * \param path what messages call the folder
 * \throw std::runtime_error if the folder holds anything else */
void
CheckOldSlices(const std::string & path, const std::filesystem::path & folder);

#endif
