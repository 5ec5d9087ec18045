// SPDX-License-Identifier: Apache-2.0
#include "Pipeline.h"

#include <cstring>
#include <thread>

using namespace itk::Subdivision;

/** Counts what was computed and what was lost, and ends the computation where another stage has failed. */
class Pipeline::Monitor : public TileMonitor
{
public:
  Monitor(const Pipeline & pipeline, Progress & progress)
    : m_Pipeline(pipeline)
    , m_Progress(progress)
    , m_All(CountAll(pipeline))
  {}

  void
  Completed(const std::size_t elements) override
  {
    const std::uint64_t done = m_Done += elements;
    if (done >= m_NextUpdate)
    {
      const std::unique_lock<std::mutex> lock(m_Mutex, std::try_to_lock);
      if (lock.owns_lock())
      {
        // The last percents are for the writer, which does not tell.
        m_Progress.Update(0.98 * static_cast<double>(done) / static_cast<double>(m_All));
        m_NextUpdate = done + m_All / 500;
      }
    }
  }

  bool
  IsStopped() const override
  {
    return m_Pipeline.m_IsStopped;
  }

  bool
  CountsLosses() const override
  {
    return true;
  }

  void
  Lost(const std::size_t notANumber, const std::size_t clamped) override
  {
    m_NotANumber += notANumber;
    m_Clamped += clamped;
  }

  Losses
  GetLosses() const
  {
    return { m_NotANumber, m_Clamped };
  }

private:
  static std::uint64_t
  CountAll(const Pipeline & pipeline)
  {
    std::uint64_t voxels = 0;
    for (const Box & piece : pipeline.m_Plan.Pieces)
    {
      voxels += CountElements(piece);
    }
    return voxels * pipeline.m_Chain.GetOutput().NumberOfComponents;
  }

  // Told of every row by every thread, so that a lock would be fought for.
  const Pipeline &           m_Pipeline;
  Progress &                 m_Progress;
  const std::uint64_t        m_All;
  std::mutex                 m_Mutex;
  std::atomic<std::uint64_t> m_Done{ 0 };
  std::atomic<std::uint64_t> m_NextUpdate{ 0 };
  std::atomic<std::uint64_t> m_NotANumber{ 0 };
  std::atomic<std::uint64_t> m_Clamped{ 0 };
};

namespace
{
/** The axis along which two boxes differ, if it is one alone and no axis after it has more than one index: then what
 * they share lies side by side in memory. Else the number of axes. */
std::size_t
FindMovingAxis(const Box & before, const Box & after)
{
  std::size_t found = after.size();
  for (std::size_t axis = 0; axis < after.size(); ++axis)
  {
    if (before[axis] != after[axis] || (found < after.size() && after[axis].Size > 1))
    {
      if (found < after.size())
      {
        return after.size();
      }
      found = axis;
    }
  }
  return found;
}

/** Bytes of one index of the last axis with more than one. */
std::uint64_t
CountBytesBelow(const Box & box, const std::size_t axis, std::uint64_t bytes)
{
  for (std::size_t i = 0; i < axis; ++i)
  {
    bytes *= box[i].Size;
  }
  return bytes;
}
} // namespace

Pipeline::Pipeline(VolumeReader & reader,
                   LevelChain &   chain,
                   VolumeWriter & writer,
                   VoxelCounter & counter,
                   const Plan &   plan)
  : m_Reader(reader)
  , m_Chain(chain)
  , m_Writer(writer)
  , m_Counter(counter)
  , m_Plan(plan)
  , m_Inputs(plan.Buffers)
  , m_Outputs(plan.Buffers)
{
  for (unsigned int i = 0; i < plan.Buffers; ++i)
  {
    m_Inputs[i].Memory.Reserve(plan.LargestRequest);
    m_Outputs[i].Memory.Reserve(plan.LargestPiece);
    m_FreeInputs.Push(&m_Inputs[i]);
    m_FreeOutputs.Push(&m_Outputs[i]);
  }
}

void
Pipeline::Fill(Buffer & buffer, const Buffer * const before, const Box & request)
{
  const std::uint64_t voxelBytes = m_Reader.GetDescription().GetVoxelBytes();
  auto * const        data = static_cast<char *>(buffer.Memory.GetData());
  Box                 rest = request;
  std::uint64_t       kept = 0;
  const std::size_t   axis = before == nullptr ? request.size() : FindMovingAxis(before->Voxels, request);
  if (axis < request.size())
  {
    const Interval &   old = before->Voxels[axis];
    const std::int64_t oldEnd = old.First + static_cast<std::int64_t>(old.Size);
    const std::int64_t end = request[axis].First + static_cast<std::int64_t>(request[axis].Size);
    if (old.First <= request[axis].First && request[axis].First < oldEnd && oldEnd <= end)
    {
      const std::uint64_t stride = CountBytesBelow(request, axis, voxelBytes);
      kept = static_cast<std::uint64_t>(oldEnd - request[axis].First) * stride;
      const std::uint64_t first = static_cast<std::uint64_t>(request[axis].First - old.First) * stride;
      std::memmove(data, static_cast<const char *>(before->Memory.GetData()) + first, kept);
      rest[axis] = { oldEnd, static_cast<std::uint64_t>(end - oldEnd) };
    }
  }
  if (CountElements(rest) > 0)
  {
    m_Reader.Read(rest, data + kept);
  }
  buffer.Voxels = request;
}

void
Pipeline::ReadPieces()
{
  const Buffer * before = nullptr;
  for (const Box & piece : m_Plan.Pieces)
  {
    Buffer * const buffer = m_FreeInputs.Pop();
    if (buffer == nullptr)
    {
      return;
    }
    this->Fill(*buffer, before, m_Chain.GetRequest(piece));
    before = buffer;
    m_FullInputs.Push(buffer);
  }
}

void
Pipeline::ComputePieces(Progress & progress)
{
  Monitor monitor(*this, progress);
  for (const Box & piece : m_Plan.Pieces)
  {
    Buffer * const input = m_FullInputs.Pop();
    Buffer * const output = input == nullptr ? nullptr : m_FreeOutputs.Pop();
    if (output == nullptr)
    {
      return;
    }
    m_Chain.Compute(input->Voxels, input->Memory.GetData(), piece, output->Memory.GetData(), monitor);
    if (m_IsStopped)
    {
      return;
    }
    m_Counter.Include(input->Voxels, input->Memory.GetData(), piece, output->Memory.GetData());
    output->Voxels = piece;
    if (m_Plan.Pieces.size() == 1)
    {
      input->Memory = PageBuffer();
    }
    m_FreeInputs.Push(input);
    m_FullOutputs.Push(output);
  }
  m_Losses = monitor.GetLosses();
}

void
Pipeline::WritePieces()
{
  for (std::size_t piece = 0; piece < m_Plan.Pieces.size(); ++piece)
  {
    Buffer * const buffer = m_FullOutputs.Pop();
    if (buffer == nullptr)
    {
      return;
    }
    m_Writer.Write(buffer->Voxels, buffer->Memory.GetData());
    m_FreeOutputs.Push(buffer);
  }
}

void
Pipeline::Stop()
{
  m_IsStopped = true;
  m_FreeInputs.Stop();
  m_FullInputs.Stop();
  m_FreeOutputs.Stop();
  m_FullOutputs.Stop();
}

template <typename TStage>
void
Pipeline::RunStage(TStage && stage)
{
  try
  {
    stage();
  }
  catch (...)
  {
    {
      const std::lock_guard<std::mutex> lock(m_Mutex);
      m_FirstError = m_FirstError ? m_FirstError : std::current_exception();
    }
    this->Stop();
  }
}

void
Pipeline::Run(Progress & progress)
{
  std::thread reader;
  std::thread writer;
  this->RunStage([&] {
    reader = std::thread([this] { this->RunStage([this] { this->ReadPieces(); }); });
    writer = std::thread([this] { this->RunStage([this] { this->WritePieces(); }); });
    this->ComputePieces(progress);
  });
  for (std::thread * const thread : { &reader, &writer })
  {
    if (thread->joinable())
    {
      thread->join();
    }
  }
  if (m_FirstError)
  {
    std::rethrow_exception(m_FirstError);
  }
}
