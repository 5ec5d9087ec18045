// SPDX-License-Identifier: Apache-2.0
#ifndef PoolMultiThreader_h
#define PoolMultiThreader_h

#include "itkPlatformMultiThreader.h"
#include "itkPoolMultiThreader.h"

#if defined(__has_feature)
#  if __has_feature(thread_sanitizer)
#    define SUBDIVISION_UNDER_THREAD_SANITIZER
#  endif
#endif
#if defined(__SANITIZE_THREAD__)
#  define SUBDIVISION_UNDER_THREAD_SANITIZER
#endif

namespace SubdivisionTest
{
/** ITK's pool of threads. The thread sanitizer, which needs all code to be built for it, does not see that the pool's
 * caller waits: it does so by std::future within ITK's library. All that other threads wrote would look like races, so
 * that new threads take the pool's place. */
#ifdef SUBDIVISION_UNDER_THREAD_SANITIZER
using PoolMultiThreader = itk::PlatformMultiThreader;
constexpr auto PoolThreader = itk::MultiThreaderBaseEnums::Threader::Platform;
#else
using PoolMultiThreader = itk::PoolMultiThreader;
constexpr auto PoolThreader = itk::MultiThreaderBaseEnums::Threader::Pool;
#endif
} // namespace SubdivisionTest

#endif
