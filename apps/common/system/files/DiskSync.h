// SPDX-License-Identifier: Apache-2.0
#ifndef DiskSync_h
#define DiskSync_h

#include "system/files/FileDescriptor.h"

#include <filesystem>
#include <system_error>

/** Brings what was written into an open file to the disk. */
std::error_code
BringToDisk(const FileDescriptor & file);

/** Brings a file or the entries of a folder to the disk. */
std::error_code
BringToDisk(const std::filesystem::path & path);

/** Brings a file to the disk and gives it its name then: it is there whole or not at all. */
std::error_code
BringToDiskAs(const std::filesystem::path & unnamed, const std::filesystem::path & name);

#endif
