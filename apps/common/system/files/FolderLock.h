// SPDX-License-Identifier: Apache-2.0
#ifndef FolderLock_h
#define FolderLock_h

#include "system/files/FileDescriptor.h"

#include <filesystem>

/** Held by one process at a time while it gives names to files of a folder that belong together. It goes with this
 * object or the process; where a folder must not be read or cannot be locked (NFS), it holds nothing. */
class FolderLock
{
public:
  /** Waits for other processes. One process must not take it twice at once. */
  explicit FolderLock(const std::filesystem::path & folder);

private:
  FileDescriptor m_Folder;
};

#endif
