// SPDX-License-Identifier: Apache-2.0
#include "system/RunRecord.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <new>
#include <system_error>

#include <sys/mman.h>

namespace
{
RunRecord * Record = nullptr;
}

SharedMutex::SharedMutex()
{
  pthread_mutexattr_t attributes;
  pthread_mutexattr_init(&attributes);
  pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED);
  pthread_mutexattr_setrobust(&attributes, PTHREAD_MUTEX_ROBUST);
  pthread_mutex_init(&m_Mutex, &attributes);
  pthread_mutexattr_destroy(&attributes);
}

bool
SharedMutex::Take(int result)
{
  if (result == EOWNERDEAD)
  {
    pthread_mutex_consistent(&m_Mutex);
    return true;
  }
  return result == 0;
}

void
SharedMutex::lock()
{
  const int result = pthread_mutex_lock(&m_Mutex);
  if (!Take(result))
  {
    throw std::system_error(result, std::generic_category());
  }
}

void
SharedMutex::unlock()
{
  pthread_mutex_unlock(&m_Mutex);
}

bool
SharedMutex::LockWithin(int seconds)
{
  timespec end = {};
  clock_gettime(CLOCK_REALTIME, &end);
  end.tv_sec += seconds;
  return Take(pthread_mutex_timedlock(&m_Mutex, &end));
}

void
SharedText::Set(const std::string & text)
{
  const std::size_t size = std::min(text.size(), sizeof(m_Text) - 1);
  std::memcpy(m_Text, text.data(), size);
  m_Text[size] = '\0';
}

std::string
SharedText::Get() const
{
  return std::string(m_Text, strnlen(m_Text, sizeof(m_Text)));
}

RunRecord &
GetRunRecord()
{
  if (Record == nullptr)
  {
    ResetRunRecord();
  }
  return *Record;
}

void
ResetRunRecord()
{
  void * const memory = mmap(nullptr, sizeof(RunRecord), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED)
  {
    throw std::bad_alloc();
  }
  if (Record != nullptr)
  {
    munmap(Record, sizeof(RunRecord));
  }
  Record = new (memory) RunRecord;
}
