// SPDX-License-Identifier: Apache-2.0
#ifndef MemoryPlan_h
#define MemoryPlan_h

#include "Options.h"
#include "Pieces.h"

#include <functional>
#include <vector>

/** Bytes that one piece needs. */
struct PieceBytes
{
  std::uint64_t Kept = 0;   // the voxels: input, output, output in its file's type
  std::uint64_t Reader = 0; // while reading
  std::uint64_t Writer = 0; // while writing
};

/** Chooses the pieces so that the process stays within its memory. */
struct MemoryPlan
{
  ImageRegion                                    Whole;
  bool                                           OutputStreams = false;
  unsigned int                                   NumberOfThreads = 1;
  std::function<PieceBytes(const ImageRegion &)> GetPieceBytes;

  /** The pieces that the options ask for.
   * \throw std::runtime_error if the memory budget of the options cannot be kept */
  std::vector<ImageRegion>
  Split(const Options & options) const;

private:
  /** The most memory that the process will have taken after all pieces. */
  std::uint64_t
  GetPeakBytes(const std::vector<ImageRegion> & pieces) const;

  std::uint64_t
  FindNumberOfPieces(std::uint64_t budget) const;
};

/** Threads that fit a memory budget, each with its scratch memory. */
unsigned int
GetNumberOfThreads(const Options & options);

#endif
