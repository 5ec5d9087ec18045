// SPDX-License-Identifier: Apache-2.0
#include "outputs/TemporaryFolder.h"
#include "system/InputFile.h"
#include "system/Interrupt.h"
#include "outputs/StagedFolder.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{
[[noreturn]] void
Fail(const fs::path & path, int error)
{
  throw std::runtime_error("cannot write " + path.string() + ": " + std::strerror(error));
}

/** Copies over a file that exists, without making it anew. The new size is taken first, while the old bytes are all
 * there. */
void
CopyOver(const fs::path & from, const fs::path & to)
{
  const InputFile     source(from.string());
  const int           descriptor = open(to.c_str(), O_WRONLY | O_CLOEXEC);
  const std::uint64_t oldSize = descriptor < 0 ? 0 : fs::file_size(to);
  std::vector<char>   bytes(1 << 20);
  bool                isDone = descriptor >= 0;
  if (isDone && source.GetSize() > oldSize)
  {
    errno = posix_fallocate(descriptor, 0, static_cast<off_t>(source.GetSize()));
    isDone = errno == 0;
    if (!isDone)
    {
      static_cast<void>(ftruncate(descriptor, static_cast<off_t>(oldSize)) == 0);
    }
  }
  for (std::uint64_t done = 0; isDone && done < source.GetSize();)
  {
    const auto count = std::min<std::uint64_t>(bytes.size(), source.GetSize() - done);
    source.ReadAt(done, bytes.data(), count);
    isDone = pwrite(descriptor, bytes.data(), count, static_cast<off_t>(done)) == static_cast<ssize_t>(count);
    done += count;
  }
  isDone = isDone && ftruncate(descriptor, static_cast<off_t>(source.GetSize())) == 0;
  const int error = errno;
  close(descriptor);
  if (!isDone)
  {
    Fail(to, error);
  }
}

/** Gives a file the permissions of the one that it is to replace, if there is one. */
void
KeepPermissions(const fs::path & replaced, const fs::path & file)
{
  std::error_code error;
  const auto      status = fs::status(replaced, error);
  if (!error && fs::exists(status))
  {
    fs::permissions(file, status.permissions(), error);
  }
}

/** Whether a file belongs to another user in a folder, such as /tmp, where nobody may rename another's files. */
bool
IsStuck(const fs::path & file)
{
  struct stat own = {};
  struct stat folder = {};
  const uid_t user = geteuid();
  return user != 0 && stat(file.c_str(), &own) == 0 && stat(file.parent_path().c_str(), &folder) == 0 &&
         (folder.st_mode & S_ISVTX) != 0 && own.st_uid != user && folder.st_uid != user;
}

/** Renames files of one image, the last of which names them all. Where it replaces one, the others of that go first, so
 * that files of two images never stand together. After an error, all is as it was. */
void
ReplaceTogether(const fs::path & folder, const fs::path & target, std::vector<fs::path> names)
{
  const fs::path aside = folder / "replaced";
  fs::create_directory(aside);
  const auto exists = [](const fs::path & path) { return fs::exists(fs::symlink_status(path)); };
  try
  {
    if (exists(target / names.back()))
    {
      std::rotate(names.begin(), names.end() - 1, names.end());
      for (auto name = names.begin() + 1; name != names.end(); ++name)
      {
        if (exists(target / *name))
        {
          fs::rename(target / *name, aside / *name);
        }
      }
      if (link((target / names.front()).c_str(), (aside / names.front()).c_str()) != 0)
      {
        fs::rename(target / names.front(), aside / names.front()); // the file system has no hard links
      }
    }
    for (const fs::path & name : names)
    {
      fs::rename(folder / name, target / name);
    }
  }
  catch (const fs::filesystem_error &)
  {
    std::error_code ignored;
    for (auto name = names.rbegin(); name != names.rend(); ++name)
    {
      if (!fs::exists(folder / *name, ignored))
      {
        fs::remove(target / *name, ignored);
      }
      fs::rename(aside / *name, target / *name, ignored);
    }
    throw;
  }
}
} // namespace

fs::path
ResolveOutput(fs::path output)
{
  std::error_code error;
  constexpr int   longestChain = 40;
  for (int i = 0; i < longestChain && fs::is_symlink(output, error); ++i)
  {
    output = output.parent_path() / fs::read_symlink(output, error);
  }
  if (fs::is_symlink(output, error))
  {
    Fail(output, ELOOP);
  }
  const fs::path folder = fs::canonical(fs::absolute(output).parent_path(), error);
  return error ? fs::absolute(output) : folder / output.filename();
}

TemporaryFolder::TemporaryFolder(const fs::path & output, const WarningSink & warn)
  : m_Output(ResolveOutput(output))
{
  std::error_code error;
  const long      longest = pathconf(m_Output.parent_path().c_str(), _PC_NAME_MAX);
  if (longest > 0 && m_Output.filename().string().size() > static_cast<std::size_t>(longest))
  {
    Fail(output, ENAMETOOLONG);
  }
  if (fs::is_directory(m_Output, error))
  {
    Fail(output, EISDIR);
  }
  if (fs::exists(m_Output, error) && !fs::is_regular_file(m_Output, error))
  {
    throw std::runtime_error("cannot write " + output.string() + ": it is not a regular file");
  }
  if (fs::exists(m_Output, error) && access(m_Output.c_str(), W_OK) != 0)
  {
    Fail(output, errno);
  }
  const bool isStuck = IsStuck(m_Output);
  m_IsInPlace = isStuck || !this->Make(m_Output.parent_path());
  if (!m_IsInPlace)
  {
    return;
  }
  const int reason = isStuck ? EPERM : errno;
  if (!fs::exists(m_Output, error) || (reason != EACCES && reason != EPERM && reason != EROFS) ||
      !this->Make(fs::temp_directory_path()))
  {
    Fail(output, reason);
  }
  warn("the folder of " + output.string() +
       " cannot be written, but the file can: it is overwritten in place, and is not whole until that is done");
}

bool
TemporaryFolder::Make(const fs::path & folder)
{
  // Short, since a file's name may be as long as the file system allows.
  std::string pattern = (folder / ".partial-XXXXXX").string();
  const auto  lock = HoldInterrupts();
  if (mkdtemp(pattern.data()) == nullptr)
  {
    return false;
  }
  m_Folder = pattern;
  RemoveWhenInterrupted(lock, m_Folder, m_Output);
  return true;
}

TemporaryFolder::~TemporaryFolder()
{
  if (!m_Folder.empty())
  {
    this->Remove(HoldInterrupts());
  }
}

void
TemporaryFolder::Remove(const InterruptLock & lock)
{
  RemoveTemporaryFolder(lock, m_Folder);
  m_Folder.clear();
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
TemporaryFolder::AllowReplacing(const std::string & name)
{
  m_Replaceable.insert(name);
}

void
TemporaryFolder::RemoveAfterwards(const std::string & name)
{
  m_Obsolete.insert(name);
}

bool
TemporaryFolder::RelyOnRoom()
{
  std::error_code error;
  m_WaitsForDisk = fs::exists(fs::symlink_status(m_Output, error));
  return !m_WaitsForDisk;
}

void
TemporaryFolder::NameDataBy(const std::string &                                     dataName,
                            const std::function<std::string(const std::string &)> & composeHeader)
{
  m_Pair = DetachedPair{ m_Folder, m_Output, dataName, composeHeader };
}

void
TemporaryFolder::GiveNames(const std::vector<fs::path> & names)
{
  const fs::path target = m_Output.parent_path();
  if (m_IsInPlace)
  {
    for (const fs::path & name : names)
    {
      CopyOver(m_Folder / name, target / name);
    }
    return;
  }
  if (m_Pair)
  {
    ::GiveNames(*m_Pair);
    return;
  }
  try
  {
    if (names.size() > 1)
    {
      ReplaceTogether(m_Folder, target, names);
    }
    else
    {
      fs::rename(m_Folder / names.front(), target / names.front());
    }
  }
  catch (const fs::filesystem_error & error)
  {
    Fail(m_Output, error.code().value());
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
  for (const fs::path & name : names)
  {
    if (m_WaitsForDisk)
    {
      // Errors of writing may show up as late as here.
      if (const int error = BringToDisk(m_Folder / name); error != 0)
      {
        Fail(m_Output, error);
      }
    }
    if (name != m_Output.filename() && m_Replaceable.count(name.string()) == 0 && fs::exists(target / name))
    {
      throw std::runtime_error("cannot write " + m_Output.string() + ": its data would replace the file " +
                               (target / name).string());
    }
    KeepPermissions(target / name, m_Folder / name);
  }
  const auto lock = HoldInterrupts();
  this->GiveNames(names);
  for (const std::string & name : m_Obsolete)
  {
    std::error_code error; // the output is complete all the same
    fs::remove(target / name, error);
  }
  this->Remove(lock);
}
