// SPDX-License-Identifier: Apache-2.0
#include "system/files/FileIdentity.h"

#include <sys/stat.h>

std::string
GetIdentity(const std::filesystem::path & path)
{
  struct stat status = {};
  return stat(path.c_str(), &status) == 0 ? std::to_string(status.st_ino) : "";
}

std::string
GetIdentity(const FileDescriptor & file)
{
  struct stat status = {};
  return fstat(file.GetNumber(), &status) == 0 ? std::to_string(status.st_ino) : "";
}
