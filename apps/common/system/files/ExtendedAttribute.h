// SPDX-License-Identifier: Apache-2.0
#ifndef ExtendedAttribute_h
#define ExtendedAttribute_h

#include <filesystem>
#include <string>

// Texts that a file system keeps beside a file, if it can.

void
SetExtendedAttribute(const std::filesystem::path & path, const std::string & name, const std::string & text);

/** Empty if there is none of that name, or it is longer than 64 KiB. */
std::string
GetExtendedAttribute(const std::filesystem::path & path, const std::string & name);

#endif
