// SPDX-License-Identifier: Apache-2.0
#ifndef Interrupt_h
#define Interrupt_h

#include <filesystem>
#include <mutex>

/** Lets a thread wait for the signals that end the program (interrupt, terminate, hang up), so that it can remove the
 * unfinished output first. To be called at the start of the program, before any other thread exists. A file size limit
 * and a closed pipe become errors of the writing function instead of signals. An exception that a library lets escape
 * from where none may ends the program as cleanly. */
void
WatchForInterrupts();

/** While this lock is held, an interrupt waits. */
using InterruptLock = std::unique_lock<std::mutex>;

InterruptLock
HoldInterrupts();

/** The folder to remove when the program is interrupted, and the output that is written there; empty for none. The lock
 * is the proof that no interrupt comes now. */
void
RemoveWhenInterrupted(const InterruptLock &         lock,
                      const std::filesystem::path & folder,
                      const std::filesystem::path & output);

#endif
