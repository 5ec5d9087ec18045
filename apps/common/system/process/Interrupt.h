// SPDX-License-Identifier: Apache-2.0
#ifndef Interrupt_h
#define Interrupt_h

#include "system/process/RunRecord.h"

#include <filesystem>
#include <mutex>

// A run that is watched (WatchedRun.h) is ended by its watcher, which then removes what the run left.

/** While this lock is held, an interrupt waits. */
using InterruptLock = std::unique_lock<SharedMutex>;

InterruptLock
HoldInterrupts();

/** The folder to remove when the run is interrupted or dies, and the output that is written there; empty for none. The
 * lock is the proof that no interrupt comes now. */
void
RemoveWhenInterrupted(const InterruptLock &         lock,
                      const std::filesystem::path & folder,
                      const std::filesystem::path & output);

/** Removes such a folder. What cannot be removed now, the watcher removes at the end of the run. */
void
RemoveTemporaryFolder(const InterruptLock & lock, const std::filesystem::path & folder);

#endif
