// SPDX-License-Identifier: Apache-2.0
#include "outputs/StagedFolder.h"
#include "system/Interrupt.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef __linux__
#  include <cstdio>
#endif

namespace fs = std::filesystem;

int
BringToDisk(const fs::path & path)
{
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
  {
    return errno;
  }
  const int error = fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
  close(descriptor);
  return error;
}

int
ExchangeNames(const fs::path & a, const fs::path & b)
{
#ifdef RENAME_EXCHANGE
  if (renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0)
  {
    return 0;
  }
#endif
  const fs::path aside = fs::path(a) += ".old";
  if (rename(b.c_str(), aside.c_str()) != 0)
  {
    return errno;
  }
  if (rename(a.c_str(), b.c_str()) != 0)
  {
    const int error = errno;
    rename(aside.c_str(), b.c_str());
    return error;
  }
  return rename(aside.c_str(), a.c_str()) == 0 ? 0 : errno;
}

StagedFolder::StagedFolder(const fs::path & output)
{
  std::error_code error;
  const fs::path  resolved = fs::weakly_canonical(output, error);
  m_Output = error ? fs::absolute(output) : resolved;
  std::string pattern = (m_Output.parent_path() / ("." + m_Output.filename().string() + ".partial-XXXXXX")).string();
  const auto  lock = HoldInterrupts();
  if (mkdtemp(pattern.data()) == nullptr)
  {
    this->Fail(errno);
  }
  m_Folder = pattern;
  RemoveWhenInterrupted(lock, m_Folder, m_Output);
}

StagedFolder::~StagedFolder() { RemoveTemporaryFolder(HoldInterrupts(), m_Folder); }

void
StagedFolder::Fail(int error) const
{
  throw std::runtime_error("cannot write " + m_Output.string() + ": " + std::strerror(error));
}

void
StagedFolder::Commit()
{
  for (const fs::directory_entry & entry : fs::directory_iterator(m_Folder))
  {
    if (const int error = BringToDisk(entry.path()); error != 0)
    {
      this->Fail(error);
    }
  }
  struct stat  status = {};
  const bool   replaces = stat(m_Output.c_str(), &status) == 0;
  const mode_t mask = umask(0);
  umask(mask);
  chmod(m_Folder.c_str(), replaces ? status.st_mode & 07777 : 0777 & ~mask);
  const auto lock = HoldInterrupts();
  const int  error = replaces                                          ? ExchangeNames(m_Folder, m_Output)
                     : rename(m_Folder.c_str(), m_Output.c_str()) == 0 ? 0
                                                                       : errno;
  if (error != 0)
  {
    this->Fail(error);
  }
}
