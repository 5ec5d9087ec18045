// SPDX-License-Identifier: Apache-2.0
#ifndef SubdividerTestHelpers_h
#define SubdividerTestHelpers_h

#include "NonOscillatorySubdivision/RunTiles.h"
#include "NonOscillatorySubdivision/Subdivider.h"
#include "TestArray.h"

#include <atomic>
#include <random>

/** Counts elements, and stops where it is told to. */
class CountingMonitor final : public itk::Subdivision::TileMonitor
{
public:
  void
  Completed(const std::size_t elements) override
  {
    m_Elements += elements;
  }

  bool
  IsStopped() const override
  {
    return m_Elements >= StopAt;
  }

  std::size_t
  GetElements() const
  {
    return m_Elements;
  }

  std::size_t StopAt = std::numeric_limits<std::size_t>::max();

private:
  std::atomic<std::size_t> m_Elements{ 0 };
};

inline std::size_t
CountElements(const TestArray::Box & box)
{
  std::size_t count = 1;
  for (const auto & interval : box)
  {
    count *= interval.Size;
  }
  return count;
}

/** Runs a Subdivider from array to array; returns the number of elements that it says to have written. */
inline std::size_t
Subdivide(const TestArray &                 input,
          const TestArray::Box &            whole,
          TestArray &                       output,
          const itk::Subdivision::Options & options,
          const unsigned int                threads,
          itk::Subdivision::Workspace &     workspace)
{
  CountingMonitor              monitor;
  itk::Subdivision::Subdivider subdivider(input.View(), whole, output.View(), options, threads, workspace);
  itk::Subdivision::RunTiles(subdivider, threads, monitor);
  return monitor.GetElements();
}

/** Fills an array with integers that 8 bits have, with or without a sign: steps, noise and ramps. */
inline void
FillWithSteps(TestArray & array, std::mt19937 & random)
{
  const double height = static_cast<double>(20 + random() % 90);
  const auto   phase = static_cast<std::int64_t>(random() % 5);
  TestArray::ForEachIndex(array.GetBox(), [&](const TestArray::Index & index) {
    std::int64_t sum = phase;
    for (const std::int64_t i : index)
    {
      sum += i;
    }
    const bool isHigh = ((sum % 5) + 5) % 5 < 2;
    array.Set(index, (isHigh ? height : 0.0) + static_cast<double>(random() % 17));
  });
}

/** A part of an array, as an array of its own. */
inline TestArray
Cut(const TestArray & whole, const TestArray::Box & box, const TestLayout & layout)
{
  TestArray part(whole.GetType(), box, layout);
  TestArray::ForEachIndex(box, [&](const TestArray::Index & index) { part.Set(index, whole.Get(index)); });
  return part;
}

#endif
