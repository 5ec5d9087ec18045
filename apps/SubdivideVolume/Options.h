// SPDX-License-Identifier: Apache-2.0
#ifndef Options_h
#define Options_h

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

/** What the user asked for on the command line. */
struct Options
{
  std::string   Input;
  std::string   Output;
  std::string   Scheme = "nonoscillatory";
  double        Tension = 2.0;
  std::string   Boundary = "nearest";
  std::string   Axes;                // letters of x, y, z, t; empty: the first three
  std::string   OutputType = "same"; // or the name of a pixel component
  std::string   Series;              // the DICOM series to take, by its UID
  unsigned int  Threads = 0;         // 0: as many as there are processors
  unsigned int  Streams = 0;         // 0: chosen from the memory
  std::uint64_t Memory = 0;          // bytes; 0: no budget given
  bool          Compress = false;
  bool          Quiet = false;
  bool          ProgressXml = false;
};

/** A command line that makes no sense. */
struct UsageError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** Reads the command line. Returns an exit code if the program has nothing left to do (--help, --xml, ...).
 * \throw UsageError */
std::optional<int>
ParseCommandLine(int argc, char * argv[], Options & options);

#endif
