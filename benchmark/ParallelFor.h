// SPDX-License-Identifier: Apache-2.0
#ifndef ParallelFor_h
#define ParallelFor_h

#include "itkMultiThreaderBase.h"

namespace subdivision_benchmark
{

/** Calls work(0) ... work(threads - 1) at once, on the threads that ITK's filters run on. */
template <typename TWork>
void
ParallelFor(unsigned int threads, const TWork & work)
{
  const auto threader = itk::MultiThreaderBase::New();
  threader->SetNumberOfWorkUnits(threads);
  threader->ParallelizeArray(0, threads, work, nullptr);
}

} // namespace subdivision_benchmark

#endif
