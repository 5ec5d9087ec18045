// SPDX-License-Identifier: Apache-2.0
#include "system/process/FinishLock.h"

#include <cerrno>
#include <chrono>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

FileDescriptor
OpenToLock(const std::filesystem::path & path)
{
  // NFS gives this lock only to who may write.
  return FileDescriptor(open(path.c_str(), O_RDWR | O_CLOEXEC));
}

FinishLock::FinishLock(const FileDescriptor & file, const std::filesystem::path & folder)
  : m_File(file)
{
  if (flock(m_File.GetNumber(), LOCK_EX) == 0)
  {
    return;
  }
  const std::filesystem::path claim = folder / "finishing";
  constexpr auto              tick = std::chrono::milliseconds(100);
  constexpr auto              patience = std::chrono::minutes(1);
  for (auto waited = tick; mkdir(claim.c_str(), 0777) != 0; waited += tick)
  {
    if (errno != EEXIST || waited > patience)
    {
      return;
    }
    std::this_thread::sleep_for(tick);
  }
  m_Claim = claim;
}

FinishLock::~FinishLock()
{
  if (m_Claim.empty())
  {
    flock(m_File.GetNumber(), LOCK_UN);
  }
  else
  {
    rmdir(m_Claim.c_str());
  }
}
