// SPDX-License-Identifier: Apache-2.0
#include "system/files/FileAccess.h"
#include "system/files/FileDescriptor.h"

#include <sys/stat.h>
#include <unistd.h>

std::error_code
CheckMayWrite(const std::filesystem::path & file)
{
  return access(file.c_str(), W_OK) == 0 ? std::error_code() : GetLastError();
}

bool
IsStuck(const std::filesystem::path & file)
{
  struct stat own = {};
  struct stat folder = {};
  const uid_t user = geteuid();
  return user != 0 && stat(file.c_str(), &own) == 0 && stat(file.parent_path().c_str(), &folder) == 0 &&
         (folder.st_mode & S_ISVTX) != 0 && own.st_uid != user && folder.st_uid != user;
}

std::optional<std::size_t>
GetLongestName(const std::filesystem::path & folder)
{
  const long longest = pathconf(folder.c_str(), _PC_NAME_MAX);
  return longest > 0 ? std::optional<std::size_t>(longest) : std::nullopt;
}
