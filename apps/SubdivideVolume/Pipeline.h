// SPDX-License-Identifier: Apache-2.0
#ifndef Pipeline_h
#define Pipeline_h

#include "Channel.h"
#include "LevelChain.h"
#include "Plan.h"
#include "Progress.h"
#include "VoxelCounter.h"
#include "system/process/PageBuffer.h"
#include "volumes/VolumeReader.h"
#include "volumes/VolumeWriter.h"

#include <atomic>
#include <exception>
#include <vector>

/** A run: one thread reads the next piece and one writes the last while this one and its helpers compute. */
class Pipeline
{
public:
  Pipeline(VolumeReader & reader, LevelChain & chain, VolumeWriter & writer, VoxelCounter & counter, const Plan & plan);

  /** Reads, computes and writes all pieces. The first error of any stage ends the others and is passed on. */
  void
  Run(Progress & progress);

  /** What the output's type could not hold, after the run. */
  const Losses &
  GetLosses() const
  {
    return m_Losses;
  }

private:
  struct Buffer
  {
    PageBuffer            Memory;
    itk::Subdivision::Box Voxels;
  };
  class Monitor;

  void
  ReadPieces();
  void
  ComputePieces(Progress & progress);
  void
  WritePieces();

  /** Keeps what a buffer shares with the one before, and reads the rest. */
  void
  Fill(Buffer & buffer, const Buffer * before, const Box & request);

  template <typename TStage>
  void
  RunStage(TStage && stage);

  void
  Stop();

  VolumeReader &      m_Reader;
  LevelChain &        m_Chain;
  VolumeWriter &      m_Writer;
  VoxelCounter &      m_Counter;
  const Plan &        m_Plan;
  std::vector<Buffer> m_Inputs;
  std::vector<Buffer> m_Outputs;
  Channel<Buffer>     m_FreeInputs;
  Channel<Buffer>     m_FullInputs;
  Channel<Buffer>     m_FreeOutputs;
  Channel<Buffer>     m_FullOutputs;
  Losses              m_Losses;
  std::atomic<bool>   m_IsStopped{ false };
  std::mutex          m_Mutex;
  std::exception_ptr  m_FirstError;
};

#endif
