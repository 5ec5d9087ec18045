// SPDX-License-Identifier: Apache-2.0
#include "system/process/SharedMutex.h"

#include <cerrno>
#include <ctime>
#include <new>
#include <system_error>

#include <pthread.h>

namespace
{
template <std::size_t VSize>
pthread_mutex_t *
Get(std::byte (&bytes)[VSize])
{
  static_assert(sizeof(pthread_mutex_t) <= VSize && alignof(pthread_mutex_t) <= alignof(std::max_align_t));
  return std::launder(reinterpret_cast<pthread_mutex_t *>(bytes));
}

/** Takes over what a process that died has left locked. */
bool
Take(pthread_mutex_t * const mutex, const int result)
{
  if (result == EOWNERDEAD)
  {
    pthread_mutex_consistent(mutex);
    return true;
  }
  return result == 0;
}
} // namespace

SharedMutex::SharedMutex()
{
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED);
  pthread_mutexattr_setrobust(&attributes, PTHREAD_MUTEX_ROBUST);
  pthread_mutex_init(new (m_Mutex) pthread_mutex_t, &attributes);
  pthread_mutexattr_destroy(&attributes);
}

void
SharedMutex::lock()
{
  const int result = pthread_mutex_lock(Get(m_Mutex));
  if (!Take(Get(m_Mutex), result))
  {
    throw std::system_error(result, std::generic_category());
  }
}

void
SharedMutex::unlock()
{
  pthread_mutex_unlock(Get(m_Mutex));
}

bool
SharedMutex::LockWithin(int seconds)
{
  timespec end = {};
  clock_gettime(CLOCK_REALTIME, &end);
  end.tv_sec += seconds;
  return Take(Get(m_Mutex), pthread_mutex_timedlock(Get(m_Mutex), &end));
}
