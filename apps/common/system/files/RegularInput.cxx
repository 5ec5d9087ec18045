// SPDX-License-Identifier: Apache-2.0
#include "system/files/RegularInput.h"
#include "system/files/FileDescriptor.h"

#include <stdexcept>

#include <sys/stat.h>
#include <unistd.h>

namespace
{
const char *
GetKind(mode_t mode)
{
  return S_ISFIFO(mode) ? "a named pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
}
} // namespace

void
CheckIsRegularInput(const std::string & path)
{
  const std::string start = "cannot read " + path + ": ";
  struct stat       status = {};
  if (stat(path.c_str(), &status) != 0 || access(path.c_str(), R_OK) != 0)
  {
    throw std::runtime_error(start + GetLastError().message());
  }
  if (!S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode))
  {
    throw std::runtime_error(start + "it is " + GetKind(status.st_mode) +
                             "; images are read from files, so store it in one first");
  }
}
