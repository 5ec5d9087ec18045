// SPDX-License-Identifier: Apache-2.0
#ifndef Options_h
#define Options_h

#include "PieceChoice.h"
#include "volumes/VolumeReader.h"
#include "volumes/VolumeWriter.h"

#include <cstdint>
#include <optional>
#include <string>

/** What the program is to do. */
enum class Task
{
  Subdivide,
  Inform,        // --info
  ListSeries,    // --list-series
  ListFormats,   // --formats
  DescribeItself // --xml
};

/** What the user asked for on the command line. */
struct Options
{
  ::Task        Task = Task::Subdivide;
  std::string   Input;
  std::string   Output; // empty where the task has none
  InputOptions  Reading;
  OutputOptions Writing;
  PieceChoice   Piece;
  bool          Labels = false; // the voxels are labels
  std::string   Scheme;
  double        Tension = 0.0;
  std::string   Boundary = "nearest";
  std::string   Axes;                // letters of x, y, z, t; empty: the first three
  unsigned int  Levels = 1;          // how many times the resolution is doubled
  std::string   OutputType = "same"; // or the name of an element type
  std::string   Target;              // the instruction set; empty: the fastest
  unsigned int  Threads = 0;         // 0: as many as there are processors
  unsigned int  Streams = 0;         // 0: chosen from the memory
  std::uint64_t Memory = 0;          // bytes; 0: no budget given
  bool          Quiet = false;
  bool          Json = false;
  bool          ProgressXml = false;
};

/** Reads the command line. Returns an exit code if the program has nothing left to do (--help, --version).
 * \throw UsageError */
std::optional<int>
ParseCommandLine(int argc, char * argv[], Options & options);

#endif
