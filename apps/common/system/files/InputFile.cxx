// SPDX-License-Identifier: Apache-2.0
#include "system/files/InputFile.h"

#include <algorithm>
#include <cerrno>
#include <stdexcept>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{
[[noreturn]] void
Fail(const std::string & path, const std::string & reason)
{
  throw std::runtime_error("cannot read " + path + ": " + reason);
}
} // namespace

// A pipe without a writer would let a blocking open() wait for ever.
InputFile::InputFile(const std::string & path)
  : m_Path(path)
  , m_File(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK))
{
  if (!m_File.IsOpen())
  {
    Fail(path, GetLastError().message());
  }
  struct stat status = {};
  const bool  isRegular = fstat(m_File.GetNumber(), &status) == 0 && S_ISREG(status.st_mode);
  if (!isRegular)
  {
    Fail(path, S_ISDIR(status.st_mode) ? "it is a folder" : "it is not a regular file; copy it to one first");
  }
  m_Size = static_cast<std::uint64_t>(status.st_size);
}

std::uint64_t
InputFile::ReadSome(std::uint64_t offset, void * bytes, std::uint64_t count) const
{
  std::uint64_t done = 0;
  while (done < count)
  {
    const auto read = pread(m_File.GetNumber(),
                            static_cast<char *>(bytes) + done,
                            std::min<std::uint64_t>(count - done, 1 << 30),
                            static_cast<off_t>(offset + done));
    if (read < 0 && errno == EINTR)
    {
      continue;
    }
    if (read < 0)
    {
      Fail(m_Path, GetLastError().message());
    }
    if (read == 0)
    {
      break;
    }
    done += static_cast<std::uint64_t>(read);
  }
  return done;
}

void
InputFile::ReadAt(std::uint64_t offset, void * bytes, std::uint64_t count) const
{
  if (this->ReadSome(offset, bytes, count) != count)
  {
    Fail(m_Path, "it is truncated");
  }
}

std::string
InputFile::ReadTextAt(std::uint64_t offset, std::uint64_t count) const
{
  if (offset >= m_Size)
  {
    return {};
  }
  std::string text(static_cast<std::size_t>(std::min(count, m_Size - offset)), '\0');
  text.resize(static_cast<std::size_t>(this->ReadSome(offset, text.data(), text.size())));
  return text;
}
