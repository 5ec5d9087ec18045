// SPDX-License-Identifier: Apache-2.0
#include "Interrupt.h"

#include "LibraryMessages.h"

#include <csignal>
#include <exception>
#include <thread>

#include <unistd.h>

namespace
{
std::mutex            InterruptMutex;
std::filesystem::path FolderToRemove;
std::filesystem::path UnfinishedOutput;

/** The signals that end the program, less those that its parent had it ignore (as nohup does). */
sigset_t
GetEndingSignals()
{
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : { SIGINT, SIGTERM, SIGHUP })
  {
    struct sigaction current = {};
    if (sigaction(signal, nullptr, &current) == 0 && current.sa_handler != SIG_IGN)
    {
      sigaddset(&signals, signal);
    }
  }
  return signals;
}

/** Another thread may create files meanwhile; it can no more once the folder is gone. */
void
RemoveFolder()
{
  std::error_code error;
  for (int attempt = 0; attempt < 10 && std::filesystem::exists(FolderToRemove, error); ++attempt)
  {
    std::filesystem::remove_all(FolderToRemove, error);
  }
}

/** Ends the program as the signal would have done, so that its parent sees that it was interrupted. */
[[noreturn]] void
DieOf(int signal)
{
  std::signal(signal, SIG_DFL);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, signal);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  kill(getpid(), signal);
  _exit(128 + signal);
}

/** HDF5's C++ classes throw in their destructors when the disk is full. */
[[noreturn]] void
DieOfAnException()
{
  RemoveFolder();
  std::fprintf(GetTerminal(),
               "SubdivideVolume: cannot write %s: the image library failed; is the disk full?\n",
               UnfinishedOutput.c_str());
  _exit(1);
}

void
WaitForInterrupt(sigset_t signals)
{
  int signal = 0;
  if (sigwait(&signals, &signal) == 0)
  {
    const std::lock_guard<std::mutex> lock(InterruptMutex);
    RemoveFolder();
    DieOf(signal);
  }
}
} // namespace

void
WatchForInterrupts()
{
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  const sigset_t signals = GetEndingSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::set_terminate(DieOfAnException);
  std::thread(WaitForInterrupt, signals).detach();
}

InterruptLock
HoldInterrupts()
{
  return InterruptLock(InterruptMutex);
}

void
RemoveWhenInterrupted(const InterruptLock &, const std::filesystem::path & folder, const std::filesystem::path & output)
{
  FolderToRemove = folder;
  UnfinishedOutput = output;
}
