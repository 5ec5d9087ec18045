// SPDX-License-Identifier: Apache-2.0
#ifndef FinishLock_h
#define FinishLock_h

#include "system/files/FileDescriptor.h"

#include <filesystem>

/** Opens the file whose lock FinishLock takes, if it is there. */
FileDescriptor
OpenToLock(const std::filesystem::path & path);

/** Held by the one process that finishes what several have made in a folder. It is a lock of an open file, which goes
 * with the process; where the file system has no locks, a folder, which another process takes over after a minute. */
class FinishLock
{
public:
  /** Waits for other processes.
   * \param file outlives this object
   * \param folder may be gone, and the lock with it */
  FinishLock(const FileDescriptor & file, const std::filesystem::path & folder);
  ~FinishLock();
  FinishLock(const FinishLock &) = delete;
  FinishLock &
  operator=(const FinishLock &) = delete;

private:
  const FileDescriptor & m_File;
  std::filesystem::path  m_Claim; // empty where there are locks
};

#endif
