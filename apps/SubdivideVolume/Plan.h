// SPDX-License-Identifier: Apache-2.0
#ifndef Plan_h
#define Plan_h

#include "LevelChain.h"
#include "Options.h"
#include "Pieces.h"
#include "volumes/VolumeReader.h"
#include "volumes/VolumeWriter.h"

#include <vector>

/** The pieces of a run, and what they take. */
struct Plan
{
  std::vector<Box> Pieces;             // of the output
  unsigned int     Buffers = 1;        // of each kind: 2 let reading, computing and writing overlap
  std::uint64_t    LargestRequest = 0; // bytes
  std::uint64_t    LargestPiece = 0;   // bytes
  std::uint64_t    PeakBytes = 0;      // the most memory that the process will have taken, about
};

/** Chooses the pieces so that the process stays within its memory.
 * \param boxes what is computed of the output, each box continuing the one before
 * \param writer null if it is not known what the output will be; then it is taken for one that is written in pieces
 * \throw std::runtime_error if the memory budget of the options cannot be kept */
Plan
MakePlan(const Options &          options,
         const LevelChain &       chain,
         const std::vector<Box> & boxes,
         const VolumeReader &     reader,
         const VolumeWriter *     writer,
         unsigned int             threads);

/** Threads that fit a memory budget, each with its scratch memory. */
unsigned int
GetNumberOfThreads(const Options & options);

#endif
