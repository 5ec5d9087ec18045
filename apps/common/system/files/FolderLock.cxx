// SPDX-License-Identifier: Apache-2.0
#include "system/files/FolderLock.h"

#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>

FolderLock::FolderLock(const std::filesystem::path & folder)
  : m_Folder(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
{
  while (m_Folder.IsOpen() && flock(m_Folder.GetNumber(), LOCK_EX) != 0 && errno == EINTR)
  {
  }
}
