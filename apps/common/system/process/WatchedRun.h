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

#endif
