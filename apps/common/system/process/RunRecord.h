// SPDX-License-Identifier: Apache-2.0
#ifndef RunRecord_h
#define RunRecord_h

#include "system/process/SharedMutex.h"

#include <atomic>
#include <cstdint>
#include <string>

/** A text that a process writes and another one reads once the first has ended. */
class SharedText
{
public:
  /** What is too long is cut. */
  void
  Set(const std::string & text);

  std::string
  Get() const;

private:
  static constexpr std::size_t LongestPath = 4096; // on Linux

  char m_Text[LongestPath + 64] = {};
};

/** What the process that runs tells the one that watches it, in memory that they share. */
struct RunRecord
{
  SharedMutex                Interrupts;        // held while no interrupt may come
  SharedText                 TemporaryFolder;   // to be removed whatever happens
  SharedText                 LinkFolder;        // likewise
  SharedText                 UnfinishedOutput;  // that is written there
  SharedText                 Task;              // how a message starts if the run dies: "cannot read a.dcm"
  std::atomic<std::uint64_t> Steps{ 0 };        // that have been made in opening
  std::atomic<int>           OpeningDepth{ 0 }; // of WatchedOpening
  std::atomic<bool>          HasEnded{ false }; // on purpose
};

/** The record of this process: shared with its watcher, if it has one. */
RunRecord &
GetRunRecord();

/** Starts with an empty record, to be shared with the processes that are forked afterwards. */
void
ResetRunRecord();

#endif
