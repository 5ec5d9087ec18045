// SPDX-License-Identifier: Apache-2.0
#include "TemporaryFolder.h"
#include "Interrupt.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{
[[noreturn]] void
Fail(const fs::path & path, int error)
{
  throw std::runtime_error("cannot write " + path.string() + ": " + std::strerror(error));
}

/** The file that a name leads to: a symbolic link is to stay one. */
fs::path
Resolve(const fs::path & output)
{
  std::error_code error;
  const fs::path  resolved = fs::weakly_canonical(output, error);
  return error ? fs::absolute(output) : resolved;
}

/** Errors of writing may show up as late as here. */
void
BringToDisk(const fs::path & file, const fs::path & output)
{
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
  {
    Fail(output, errno);
  }
  const int result = fsync(descriptor);
  const int error = errno;
  close(descriptor);
  if (result != 0 && error != EINVAL)
  {
    Fail(output, error);
  }
}
} // namespace

TemporaryFolder::TemporaryFolder(const fs::path & output)
  : m_Output(Resolve(output))
{
  std::error_code error;
  if (fs::is_directory(m_Output, error))
  {
    Fail(output, EISDIR);
  }
  if (fs::exists(m_Output, error) && access(m_Output.c_str(), W_OK) != 0)
  {
    Fail(output, errno);
  }
  std::string pattern = (m_Output.parent_path() / ("." + m_Output.filename().string() + ".partial-XXXXXX")).string();
  const auto  lock = HoldInterrupts();
  if (mkdtemp(pattern.data()) == nullptr)
  {
    Fail(output, errno);
  }
  m_Folder = pattern;
  RemoveWhenInterrupted(lock, m_Folder, m_Output);
}

TemporaryFolder::~TemporaryFolder()
{
  std::error_code error;
  const auto      lock = HoldInterrupts();
  fs::remove_all(m_Folder, error);
  RemoveWhenInterrupted(lock, {}, {});
}

fs::path
TemporaryFolder::GetFileName() const
{
  return m_Folder / m_Output.filename();
}

void
TemporaryFolder::CheckThatAllWasWritten() const
{
  const fs::path          probe = m_Folder / "probe";
  const std::vector<char> bytes(1 << 16, 1);
  const int               descriptor = open(probe.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  errno = ENOSPC;
  const auto written = descriptor < 0 ? -1 : write(descriptor, bytes.data(), bytes.size());
  const int  error = errno;
  close(descriptor);
  fs::remove(probe);
  if (written != static_cast<ssize_t>(bytes.size()))
  {
    throw std::runtime_error(std::strerror(error));
  }
  rlimit limit = {};
  getrlimit(RLIMIT_FSIZE, &limit);
  for (const fs::directory_entry & entry : fs::directory_iterator(m_Folder))
  {
    if (limit.rlim_cur != RLIM_INFINITY && entry.file_size() >= limit.rlim_cur)
    {
      throw std::runtime_error(std::strerror(EFBIG));
    }
  }
}

void
TemporaryFolder::Clear()
{
  for (const fs::directory_entry & entry : fs::directory_iterator(m_Folder))
  {
    fs::remove_all(entry.path());
  }
}

void
TemporaryFolder::Commit()
{
  std::vector<fs::path> names;
  for (const fs::directory_entry & entry : fs::directory_iterator(m_Folder))
  {
    names.push_back(entry.path().filename());
  }
  // The named output goes last: it must not refer to files that are not there yet.
  std::stable_partition(names.begin(), names.end(), [this](const auto & name) { return name != m_Output.filename(); });

  const fs::path target = m_Output.parent_path();
  const bool     replaces = fs::exists(m_Output);
  for (const fs::path & name : names)
  {
    BringToDisk(m_Folder / name, m_Output);
    if (!replaces && fs::exists(target / name))
    {
      throw std::runtime_error("cannot write " + m_Output.string() + ": its data would replace the file " +
                               (target / name).string());
    }
  }
  const auto lock = HoldInterrupts();
  for (const fs::path & name : names)
  {
    fs::rename(m_Folder / name, target / name);
  }
}
