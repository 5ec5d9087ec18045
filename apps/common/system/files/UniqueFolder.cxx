// SPDX-License-Identifier: Apache-2.0
#include "system/files/UniqueFolder.h"
#include "system/files/FileDescriptor.h"

#include <cstdlib>
#include <string>

#include <sys/stat.h>

std::filesystem::path
MakeUniqueFolder(const std::filesystem::path & start, std::error_code & error)
{
  std::string pattern = start.string() + "XXXXXX";
  if (mkdtemp(pattern.data()) == nullptr)
  {
    error = GetLastError();
    return {};
  }
  error.clear();
  return pattern;
}

void
AllowUsualAccess(const std::filesystem::path & folder)
{
  const mode_t mask = umask(0);
  umask(mask);
  chmod(folder.c_str(), 0777 & ~mask);
}
