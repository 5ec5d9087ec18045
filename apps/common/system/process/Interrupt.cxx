// SPDX-License-Identifier: Apache-2.0
#include "system/process/Interrupt.h"

InterruptLock
HoldInterrupts()
{
  return InterruptLock(GetRunRecord().Interrupts);
}

void
RemoveWhenInterrupted(const InterruptLock &, const std::filesystem::path & folder, const std::filesystem::path & output)
{
  RunRecord & record = GetRunRecord();
  record.TemporaryFolder.Set(folder);
  record.UnfinishedOutput.Set(output);
}

void
RemoveTemporaryFolder(const InterruptLock & lock, const std::filesystem::path & folder)
{
  std::error_code error;
  std::filesystem::remove_all(folder, error);
  if (!error)
  {
    RemoveWhenInterrupted(lock, {}, {});
  }
}
