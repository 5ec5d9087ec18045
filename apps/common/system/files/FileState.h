// SPDX-License-Identifier: Apache-2.0
#ifndef FileState_h
#define FileState_h

#include <filesystem>
#include <string>

/** The number, bytes, latest time and a checksum of the names, sizes and times of the files of an image, in words that
 * differ when one of them is changed or replaced: all of a folder but hidden ones, or one file with the data files that
 * may be beside it. */
std::string
DescribeFiles(const std::filesystem::path & image);

/** \throw std::runtime_error if the files of an image are not as they were described */
void
CheckFiles(const std::filesystem::path & image, const std::string & description);

#endif
