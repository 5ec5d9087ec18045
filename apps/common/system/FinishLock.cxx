// SPDX-License-Identifier: Apache-2.0
#include "system/FinishLock.h"

#include <cerrno>
#include <chrono>
#include <thread>

#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

FinishLock::FinishLock(const int descriptor, const std::filesystem::path & folder)
  : m_Descriptor(descriptor)
{
  if (flock(m_Descriptor, LOCK_EX) == 0)
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
    flock(m_Descriptor, LOCK_UN);
  }
  else
  {
    rmdir(m_Claim.c_str());
  }
}
