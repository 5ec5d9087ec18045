// SPDX-License-Identifier: Apache-2.0
// A program whose run ends in the way its first argument names, for watched_run_test.py. The second one is a file to be
// made in a temporary folder first; of "dicom", the file or folder to read.

#include "dicom/Dicom.h"
#include "system/process/Interrupt.h"
#include "system/process/LibraryMessages.h"
#include "system/process/Terminal.h"
#include "system/process/WatchedRun.h"
#include "system/process/WatchedTask.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

namespace
{
namespace fs = std::filesystem;

/** Turns for ever. */
[[noreturn]] void
Loop(bool makesSteps)
{
  for (volatile unsigned int i = 0;; i = i + 1)
  {
    if (makesSteps && i % 1000 == 0)
    {
      WatchedOpening::Step("loop.dcm");
    }
  }
}

int
Sleep()
{
  std::puts("ready");
  std::fflush(stdout);
  std::this_thread::sleep_for(std::chrono::seconds(60));
  return 0;
}

/** As a commit of several files that must not be torn apart. */
int
Commit(const fs::path & folder)
{
  const auto lock = HoldInterrupts();
  std::puts("ready");
  std::fflush(stdout);
  std::this_thread::sleep_for(std::chrono::seconds(1));
  std::ofstream(folder.parent_path() / "committed") << "whole";
  return 0;
}

/** Reads all voxels. */
int
ReadDicom(const std::string & path)
{
  const LibraryMessages messages;
  const auto            reader = OpenDicom(path, {}, [](const std::string &) {});
  const auto &          description = reader->GetDescription();
  itk::Subdivision::Box box;
  for (const std::uint64_t size : description.Grid.Size)
  {
    box.push_back({ 0, size });
  }
  std::vector<char> voxels(description.GetBytes());
  reader->Read(box, voxels.data());
  return 0;
}

int
Run(const std::string & way, const fs::path & file)
{
  if (way == "dicom")
  {
    return ReadDicom(file);
  }
  const LibraryMessages messages;
  const fs::path        folder = file.parent_path() / ".partial";
  if (!file.empty())
  {
    const auto lock = HoldInterrupts();
    fs::create_directory(folder);
    std::ofstream(folder / file.filename()) << "half";
    RemoveWhenInterrupted(lock, folder, file);
  }
  const WatchedTask                                 task("cannot read in.tif");
  const std::map<std::string, std::function<int()>> ways = {
    { "return", [] { return 7; } },
    { "print",
      [] {
        std::printf("result");
        std::fputs("progress\n", GetTerminal());
        return 0;
      } },
    { "throw", []() -> int { throw std::runtime_error("reason\nof two lines"); } },
    { "segv",
      [] {
        std::cerr << "strip 7 is odd\n";
        return raise(SIGSEGV);
      } },
    { "segv-thread",
      [] {
        std::thread([] { *static_cast<volatile int *>(nullptr) = 1; }).join();
        return 0;
      } },
    { "abort",
      []() -> int {
        std::fputs("assertion failed: rows == 3\n", stderr);
        std::abort();
      } },
    { "exit", []() -> int { std::exit(0); } },
    { "exit-3", []() -> int { _exit(3); } },
    { "kill", [] { return raise(SIGKILL); } },
    { "loop",
      []() -> int {
        const WatchedOpening                        opening("loop.dcm");
        Loop(false);
      } },
    { "loop-with-steps",
      []() -> int {
        const WatchedOpening                        opening("loop.dcm");
        Loop(true);
      } },
    { "sleep", Sleep },
    { "commit", [&folder] { return Commit(folder); } },
  };
  return ways.at(way)();
}
} // namespace

int
main(int argc, char * argv[])
{
  constexpr double longestOpening = 1;
  return RunWatched([&] { return Run(argv[1], argc > 2 ? argv[2] : ""); }, longestOpening);
}
