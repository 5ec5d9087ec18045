// SPDX-License-Identifier: Apache-2.0
#ifndef WatchedTask_h
#define WatchedTask_h

#include <string>

// What a run tells its watcher (WatchedRun.h) that it is about to do.

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
