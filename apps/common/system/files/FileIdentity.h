// SPDX-License-Identifier: Apache-2.0
#ifndef FileIdentity_h
#define FileIdentity_h

#include "system/files/FileDescriptor.h"

#include <filesystem>
#include <string>

// What tells a file or folder from one that takes its name later; it stays when it is renamed. Empty if there is none.

std::string
GetIdentity(const std::filesystem::path & path);

std::string
GetIdentity(const FileDescriptor & file);

#endif
