// SPDX-License-Identifier: Apache-2.0
#include "system/files/DiskRoom.h"
#include "system/files/FileDescriptor.h"

#include <cerrno>
#include <stdexcept>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

std::error_code
TryToWriteIn(const std::filesystem::path & folder)
{
  const std::filesystem::path probe = folder / "probe";
  const std::vector<char>     bytes(1 << 16, 1);
  std::error_code             error;
  {
    const FileDescriptor file(open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
    // Where only a part was written, the system tells no error.
    errno = file.IsOpen() ? ENOSPC : errno;
    if (!file.IsOpen() || write(file.GetNumber(), bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
    {
      error = GetLastError();
    }
  }
  std::filesystem::remove(probe);
  return error;
}

std::optional<std::uint64_t>
GetFreeBytes(const std::filesystem::path & folder)
{
  std::error_code error;
  const auto      space = std::filesystem::space(folder, error);
  return error ? std::nullopt : std::optional<std::uint64_t>(space.available);
}

void
CheckFreeBytes(const std::string & path, const std::filesystem::path & folder, const std::uint64_t bytes)
{
  const auto free = GetFreeBytes(folder);
  if (free && *free < bytes)
  {
    throw std::runtime_error("cannot write " + path + ": the disk has room for " + std::to_string(*free) + " bytes, " +
                             std::to_string(bytes) + " are needed");
  }
}

std::optional<std::uint64_t>
GetFileSizeLimit()
{
  rlimit limit = {};
  getrlimit(RLIMIT_FSIZE, &limit);
  return limit.rlim_cur == RLIM_INFINITY ? std::nullopt : std::optional<std::uint64_t>(limit.rlim_cur);
}
