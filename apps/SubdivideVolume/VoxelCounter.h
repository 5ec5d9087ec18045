// SPDX-License-Identifier: Apache-2.0
#ifndef VoxelCounter_h
#define VoxelCounter_h

#include "LevelChain.h"
#include "Statistics.h"

/** Counts, piece by piece, the voxels that are read and computed. */
class VoxelCounter
{
public:
  VoxelCounter(const LevelChain & chain, const ImageDescription & input, unsigned int threads);

  /** Counts a piece of the output, and its share of the input. */
  void
  Include(const Box & request, const void * input, const Box & piece, const void * output);

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

private:
  Statistics
  CountPart(itk::Subdivision::ElementType type, const Box & box, const void * elements, const Box & part) const;

  const LevelChain &            m_Chain;
  itk::Subdivision::ElementType m_InputType;
  unsigned int                  m_Components;
  unsigned int                  m_Threads;
  Statistics                    m_Input;
  Statistics                    m_Output;
};

#endif
