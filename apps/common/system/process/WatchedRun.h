// SPDX-License-Identifier: Apache-2.0
#ifndef WatchedRun_h
#define WatchedRun_h

#include <functional>
#include <string>

/** Seconds of processor time that opening may take without a step: a broken header must not keep it for ever. */
inline constexpr double LongestOpening = 60;

/** Runs a function in a child process and waits for it. Whatever ends the child becomes an exit code of this program,
 * and its temporary folder (Interrupt.h) is removed:
 * - what the function returns is passed on, after its output has been flushed; the libraries' own ends are not called;
 * - an exception, a signal, or an exit that is not the program's own is told in one line on the terminal, with what the
 *   libraries said, and gives 1;
 * - opening that makes no step for \c longestOpening is ended likewise;
 * - interrupt, terminate and hang up end the child, outside of HoldInterrupts(), and then this process by that signal.
 * A file size limit and a closed pipe are errors of the writing function in the child, no signals. To be called before
 * any thread exists and before memory is filled. */
int
RunWatched(const std::function<int()> & run, double longestOpening = LongestOpening);

/** Ends the run with an exit code that is the program's own. */
[[noreturn]] void
EndRun(int code);

/** While one exists, a message that a library took the program down starts so: "cannot read a.dcm". */
class WatchedTask
{
public:
  explicit WatchedTask(const std::string & failure);
  ~WatchedTask();
  WatchedTask(const WatchedTask &) = delete;
  WatchedTask &
  operator=(const WatchedTask &) = delete;

private:
  const std::string m_Outer;
};

/** While one exists, an input is opened: that it comes to an end is watched, too. */
class WatchedOpening
{
public:
  explicit WatchedOpening(const std::string & path);
  ~WatchedOpening();
  WatchedOpening(const WatchedOpening &) = delete;
  WatchedOpening &
  operator=(const WatchedOpening &) = delete;

  /** Goes on to a file, if several make up the input; the time starts anew. */
  static void
  Step(const std::string & path);

private:
  const WatchedTask m_Task;
};

#endif
