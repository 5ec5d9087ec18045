// SPDX-License-Identifier: Apache-2.0
#include "outputs/ReplacedFiles.h"
#include "system/files/InputFile.h"
#include "system/files/OutputFile.h"

#include <algorithm>
#include <stdexcept>

namespace fs = std::filesystem;

bool
KeepPermissions(const fs::path & replaced, const fs::path & file)
{
  std::error_code error;
  const auto      status = fs::status(replaced, error);
  if (error || !fs::exists(status))
  {
    return false;
  }
  fs::permissions(file, status.permissions(), error);
  return true;
}

namespace
{
/** Takes room for a larger file, or leaves it as it is. */
void
ExtendOrKeep(OutputFile & file, const std::uint64_t oldSize, const std::uint64_t size)
{
  try
  {
    file.Extend(size);
  }
  catch (const std::runtime_error &)
  {
    try
    {
      file.Resize(oldSize);
    }
    catch (const std::runtime_error &)
    {
      // What kept it from growing is what the user is told.
    }
    throw;
  }
}
} // namespace

void
CopyOver(const fs::path & from, const fs::path & to)
{
  const InputFile     source(from.string());
  OutputFile          file(to.string(), to.string(), OutputFile::Opening::Kept);
  const std::uint64_t oldSize = fs::file_size(to);
  if (source.GetSize() > oldSize)
  {
    ExtendOrKeep(file, oldSize, source.GetSize());
  }
  std::vector<char> bytes(1 << 20);
  for (std::uint64_t done = 0; done < source.GetSize();)
  {
    const auto count = std::min<std::uint64_t>(bytes.size(), source.GetSize() - done);
    source.ReadAt(done, bytes.data(), count);
    file.WriteAt(done, bytes.data(), count);
    done += count;
  }
  file.Resize(source.GetSize());
  file.BringToDisk();
  file.Close();
}

namespace
{
bool
Exists(const fs::path & path)
{
  return fs::exists(fs::symlink_status(path));
}

/** Puts the files that bear the names into another folder. The first, which names them all, keeps its own name as well:
 * the one that replaces it takes that in one step. */
void
PutAside(const fs::path & target, const std::vector<fs::path> & names, const fs::path & aside)
{
  for (auto name = names.begin() + 1; name != names.end(); ++name)
  {
    if (Exists(target / *name))
    {
      fs::rename(target / *name, aside / *name);
    }
  }
  std::error_code error;
  fs::create_hard_link(target / names.front(), aside / names.front(), error);
  if (error)
  {
    fs::rename(target / names.front(), aside / names.front()); // the file system has no hard links
  }
}

void
PutBack(const fs::path & folder, const fs::path & target, const std::vector<fs::path> & names, const fs::path & aside)
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
}
} // namespace

void
ReplaceTogether(const fs::path & folder, const fs::path & target, std::vector<fs::path> names)
{
  const fs::path aside = folder / "replaced";
  fs::create_directory(aside);
  try
  {
    if (Exists(target / names.back()))
    {
      std::rotate(names.begin(), names.end() - 1, names.end());
      PutAside(target, names, aside);
    }
    for (const fs::path & name : names)
    {
      fs::rename(folder / name, target / name);
    }
  }
  catch (const fs::filesystem_error &)
  {
    PutBack(folder, target, names, aside);
    throw;
  }
}
