// SPDX-License-Identifier: Apache-2.0
#ifndef VoxelCounter_h
#define VoxelCounter_h

#include "LevelChain.h"
#include "PageBuffer.h"
#include "Statistics.h"

/** Counts, piece by piece, the voxels that are read and computed, and those that the output's type could not hold: for
 * these, the piece is computed once more in real numbers, but only where the output has a limit of its type. */
class VoxelCounter
{
public:
  VoxelCounter(LevelChain & chain, const ImageDescription & input, const Options & options, unsigned int threads);

  /** Bytes that the counting of a piece takes. */
  static std::uint64_t
  GetScratchBytes(const LevelChain & chain, const Box & piece);

  /** Counts a piece of the output, and its share of the input. */
  void
  Include(const Box &                           request,
          const void *                          input,
          const Box &                           piece,
          const void *                          output,
          const itk::Subdivision::TileMonitor & monitor);

  const Statistics &
  GetInput() const
  {
    return m_Input;
  }
  const Statistics &
  GetOutput() const
  {
    return m_Output;
  }
  const Losses &
  GetLosses() const
  {
    return m_Losses;
  }

private:
  bool
  MayLose(const Box & request, const void * input, const Box & slab, const Statistics & output) const;

  Statistics
  CountPart(itk::Subdivision::ElementType type, const Box & box, const void * elements, const Box & part) const;

  LevelChain &                  m_Chain;
  itk::Subdivision::ElementType m_InputType;
  unsigned int                  m_Components;
  unsigned int                  m_Threads;
  bool                          m_KeepsRange;  // the scheme, that of the neighbours
  bool                          m_HasConstant; // beyond the image
  Statistics                    m_Input;
  Statistics                    m_Output;
  Losses                        m_Losses;
  PageBuffer                    m_Reals;
};

#endif
