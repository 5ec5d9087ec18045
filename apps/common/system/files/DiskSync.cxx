// SPDX-License-Identifier: Apache-2.0
#include "system/files/DiskSync.h"

#include <cerrno>

#include <fcntl.h>
#include <unistd.h>

std::error_code
BringToDisk(const FileDescriptor & file)
{
  // EINVAL: the file system has no disk.
  return fsync(file.GetNumber()) == 0 || errno == EINVAL ? std::error_code() : GetLastError();
}

std::error_code
BringToDisk(const std::filesystem::path & path)
{
  const FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  return file.IsOpen() ? BringToDisk(file) : GetLastError();
}

std::error_code
BringToDiskAs(const std::filesystem::path & unnamed, const std::filesystem::path & name)
{
  std::error_code error = BringToDisk(unnamed);
  if (!error)
  {
    std::filesystem::rename(unnamed, name, error);
  }
  return error;
}
