// SPDX-License-Identifier: Apache-2.0
#include "outputs/TemporaryFolder.h"
#include "outputs/ReplacedFiles.h"
#include "system/files/DiskRoom.h"
#include "system/files/DiskSync.h"
#include "system/files/FileAccess.h"
#include "system/files/UniqueFolder.h"
#include "system/process/Interrupt.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace fs = std::filesystem;

namespace
{
[[noreturn]] void
Fail(const fs::path & path, const std::error_code & error)
{
  throw std::runtime_error("cannot write " + path.string() + ": " + error.message());
}

[[noreturn]] void
Fail(const fs::path & path, const std::errc error)
{
  Fail(path, std::make_error_code(error));
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
    Fail(output, std::errc::too_many_symbolic_link_levels);
  }
  const fs::path folder = fs::canonical(fs::absolute(output).parent_path(), error);
  return error ? fs::absolute(output) : folder / output.filename();
}

void
WarnOfLinkToPair(const fs::path & output, const WarningSink & warn)
{
  std::error_code error;
  if (fs::is_symlink(output, error))
  {
    warn(output.string() + " is a link: both files of the image are written where it leads to; read it as " +
         ResolveOutput(output).string());
  }
}

TemporaryFolder::TemporaryFolder(const fs::path & output, const WarningSink & warn)
  : m_Output(ResolveOutput(output))
{
  this->CheckOutput(output);
  const bool            isStuck = IsStuck(m_Output);
  const std::error_code error =
    isStuck ? std::make_error_code(std::errc::operation_not_permitted) : this->Make(m_Output.parent_path());
  if (!error)
  {
    return;
  }
  std::error_code unknown;
  const bool      isForbidden = error == std::errc::permission_denied || error == std::errc::operation_not_permitted ||
                           error == std::errc::read_only_file_system;
  if (!isForbidden || !fs::exists(m_Output, unknown))
  {
    Fail(output, error);
  }
  if (this->Make(fs::temp_directory_path()))
  {
    Fail(output, error);
  }
  m_IsInPlace = true;
  warn("the folder of " + output.string() +
       " cannot be written, but the file can: it is overwritten in place, and is not whole until that is done");
}

void
TemporaryFolder::CheckOutput(const fs::path & output) const
{
  std::error_code unknown;
  const auto      longest = GetLongestName(m_Output.parent_path());
  if (longest && m_Output.filename().string().size() > *longest)
  {
    Fail(output, std::errc::filename_too_long);
  }
  if (!fs::exists(m_Output, unknown))
  {
    return;
  }
  if (fs::is_directory(m_Output, unknown))
  {
    Fail(output, std::errc::is_a_directory);
  }
  if (!fs::is_regular_file(m_Output, unknown))
  {
    throw std::runtime_error("cannot write " + output.string() + ": it is not a regular file");
  }
  if (const std::error_code error = CheckMayWrite(m_Output))
  {
    Fail(output, error);
  }
}

std::error_code
TemporaryFolder::Make(const fs::path & folder)
{
  std::error_code error;
  const auto      lock = HoldInterrupts();
  // Short, since a file's name may be as long as the file system allows.
  const fs::path made = MakeUniqueFolder(folder / ".partial-", error);
  if (!error)
  {
    m_Folder = made;
    RemoveWhenInterrupted(lock, m_Folder, m_Output);
  }
  return error;
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
  if (const std::error_code error = TryToWriteIn(m_Folder))
  {
    throw std::runtime_error(error.message());
  }
  const std::optional<std::uint64_t> limit = GetFileSizeLimit();
  for (const fs::directory_entry & entry : fs::directory_iterator(m_Folder))
  {
    if (limit && entry.file_size() >= *limit)
    {
      throw std::runtime_error(std::make_error_code(std::errc::file_too_large).message());
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
    Fail(m_Output, error.code());
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
      if (const std::error_code error = BringToDisk(m_Folder / name))
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
