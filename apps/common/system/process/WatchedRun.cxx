// SPDX-License-Identifier: Apache-2.0
#include "system/process/WatchedRun.h"

#include "system/process/LibraryMessages.h"
#include "system/process/RunRecord.h"
#include "system/process/Terminal.h"
#include "text/LibraryWarnings.h"
#include "text/OneLineMessage.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef APPS_COUNT_LINES
extern "C" void
__gcov_dump();
#endif

namespace
{
void
Tell(const std::string & message)
{
  TellUser(MakeOneLine(message));
}

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

/** Files must not get the numbers of streams that the parent has closed: what is printed would go there. Printing fails
 * all the same. */
void
OccupyClosedStreams()
{
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor)
  {
    if (fcntl(descriptor, F_GETFD) < 0)
    {
      static_cast<void>(open("/dev/null", O_RDONLY)); // the least free number
    }
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

/** HDF5's C++ classes throw in their destructors when the disk is full, or a file that is read is damaged. */
[[noreturn]] void
DieOfAnException()
{
  const std::string output = GetRunRecord().UnfinishedOutput.Get();
  const std::string task = GetRunRecord().Task.Get();
  const std::string temporary = GetRunRecord().TemporaryFolder.Get();
  // What was written is read back.
  const bool isOfOutput = !temporary.empty() && task.find(temporary) != std::string::npos;
  if (task.rfind("cannot read ", 0) == 0 && !isOfOutput)
  {
    Tell(task + ": the image library failed; the file is damaged");
    EndRun(1);
  }
  if (output.empty())
  {
    std::abort();
  }
  Tell("cannot write " + output + ": the image library failed; is the disk full?");
  EndRun(1);
}

/** What the child does. */
[[noreturn]] void
RunInChild(const std::function<int()> & run, pid_t watcher, const sigset_t & mask)
{
  for (const int signal : { SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ })
  {
    std::signal(signal, SIG_IGN); // the first three are the watcher's
  }
  pthread_sigmask(SIG_SETMASK, &mask, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != watcher)
  {
    _exit(1);
  }
  std::set_terminate(DieOfAnException);
  try
  {
    EndRun(run());
  }
  catch (const std::bad_alloc &)
  {
    Tell("there is not enough memory");
  }
  catch (const std::exception & error)
  {
    Tell(error.what());
  }
  EndRun(1);
}

/** Processor time of a process, in seconds. */
double
GetProcessorTime(pid_t process)
{
  clockid_t clock = {};
  timespec  time = {};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &time) != 0)
  {
    return 0;
  }
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/** Notes when opening made its last step. */
class StepTimer
{
public:
  explicit StepTimer(pid_t process)
    : m_Process(process)
  {}

  /** Seconds of processor time without a step; 0 outside of opening. */
  double
  GetIdleTime()
  {
    const RunRecord &   record = GetRunRecord();
    const std::uint64_t steps = record.Steps;
    const double        time = GetProcessorTime(m_Process);
    if (record.OpeningDepth == 0 || steps != m_Steps)
    {
      m_Steps = steps;
      m_LastStep = time;
    }
    return time - m_LastStep;
  }

private:
  const pid_t   m_Process;
  std::uint64_t m_Steps = 0;
  double        m_LastStep = 0;
};

/** How the child ended. */
struct Ending
{
  int                Status = 0; // as waitpid() gives it
  std::optional<int> Interrupt;  // the signal that this process got
  bool               WasEndless = false;
};

/** Ends the child where it holds no lock. */
int
KillChild(pid_t child)
{
  constexpr int patience = 10;
  const bool    isLocked = GetRunRecord().Interrupts.LockWithin(patience);
  kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR)
  {
  }
  if (isLocked)
  {
    GetRunRecord().Interrupts.unlock();
  }
  return status;
}

Ending
WaitForChild(pid_t child, const sigset_t & endingSignals, double longestOpening)
{
  sigset_t awaited = endingSignals;
  sigaddset(&awaited, SIGCHLD);
  StepTimer timer(child);
  while (true)
  {
    Ending ending;
    if (waitpid(child, &ending.Status, WNOHANG) == child)
    {
      return ending;
    }
    if (timer.GetIdleTime() > longestOpening)
    {
      ending.WasEndless = true;
      ending.Status = KillChild(child);
      return ending;
    }
    constexpr timespec tick = { 0, 200000000 };
    const int          signal = sigtimedwait(&awaited, nullptr, &tick);
    if (signal > 0 && signal != SIGCHLD)
    {
      ending.Interrupt = signal;
      ending.Status = KillChild(child);
      return ending;
    }
  }
}

void
RemoveTemporaryFolders()
{
  for (const std::string & folder : { GetRunRecord().TemporaryFolder.Get(), GetRunRecord().LinkFolder.Get() })
  {
    std::error_code error;
    if (!folder.empty())
    {
      std::filesystem::remove_all(folder, error);
    }
  }
}

/** The end of what the libraries printed, which tells most. */
std::string
QuoteLibraries()
{
  constexpr std::size_t most = 400;
  const std::string     all = RemoveSourceLines(LibraryMessages::GetWholeText());
  std::string           text = all.size() > most ? "... " + all.substr(all.size() - most) : all;
  // It may quote a damaged file.
  std::replace_if(text.begin(), text.end(), [](char c) { return (c < ' ' && c != '\n') || c > '~'; }, '?');
  return text.find_first_not_of(" \t\r\n") == std::string::npos ? "" : "; it said: " + text;
}

std::string
Explain(const Ending & ending)
{
  if (ending.WasEndless)
  {
    return "the image library comes to no end; the file is damaged";
  }
  if (!WIFSIGNALED(ending.Status))
  {
    return "the image library ended the program" + QuoteLibraries();
  }
  const int signal = WTERMSIG(ending.Status);
  if (signal == SIGKILL)
  {
    return "the program was killed, as happens when memory runs out; try a smaller --memory";
  }
  return std::string("the image library failed (") + strsignal(signal) + ")" + QuoteLibraries();
}
} // namespace

int
RunWatched(const std::function<int()> & run, double longestOpening)
{
  OccupyClosedStreams();
  ResetRunRecord();
  LibraryMessages::Prepare();
  std::fflush(nullptr);
  std::signal(SIGCHLD, SIG_DFL);
  const sigset_t endingSignals = GetEndingSignals();
  sigset_t       blocked = endingSignals;
  sigset_t       mask;
  sigaddset(&blocked, SIGCHLD);
  pthread_sigmask(SIG_BLOCK, &blocked, &mask);
  const pid_t watcher = getpid();
  const pid_t child = fork();
  if (child < 0)
  {
    Tell(std::string("cannot start: ") + std::strerror(errno));
    return 1;
  }
  if (child == 0)
  {
    RunInChild(run, watcher, mask);
  }
  const Ending ending = WaitForChild(child, endingSignals, longestOpening);
  RemoveTemporaryFolders();
  if (ending.Interrupt)
  {
    DieOf(*ending.Interrupt);
  }
  pthread_sigmask(SIG_SETMASK, &mask, nullptr);
  if (GetRunRecord().HasEnded && WIFEXITED(ending.Status))
  {
    // Not by way of the libraries' destructors, which take milliseconds: here nothing was made.
    EndRun(WEXITSTATUS(ending.Status));
  }
  const std::string task = GetRunRecord().Task.Get();
  const bool        mayBeDamaged =
    task.rfind("cannot read ", 0) == 0 && WIFSIGNALED(ending.Status) && WTERMSIG(ending.Status) != SIGKILL;
  Tell((task.empty() ? "" : task + ": ") +
       (mayBeDamaged ? "the file is damaged, or of a kind that is not supported: " : "") + Explain(ending));
  return 1;
}

void
EndRun(int code)
{
  std::fflush(nullptr);
  GetRunRecord().HasEnded = true;
#ifdef APPS_COUNT_LINES
  __gcov_dump(); // what atexit() would have done
#endif
  _exit(code);
}
