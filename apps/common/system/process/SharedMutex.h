// SPDX-License-Identifier: Apache-2.0
#ifndef SharedMutex_h
#define SharedMutex_h

#include <cstddef>

/** A lock that two processes share, in memory that they share, and that outlives the one that held it. */
class SharedMutex
{
public:
  SharedMutex();
  SharedMutex(const SharedMutex &) = delete;
  SharedMutex &
  operator=(const SharedMutex &) = delete;

  void
  lock();

  void
  unlock();

  /** \return whether it could be locked within some seconds */
  bool
  LockWithin(int seconds);

private:
  alignas(std::max_align_t) std::byte m_Mutex[64]; // the system's
};

#endif
