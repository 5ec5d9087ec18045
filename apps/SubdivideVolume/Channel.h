// SPDX-License-Identifier: Apache-2.0
#ifndef Channel_h
#define Channel_h

#include <condition_variable>
#include <deque>
#include <mutex>
#include <utility>

/** Hands buffers from one thread to another, first in, first out. How many there are bounds it. */
template <typename T>
class Channel
{
public:
  void
  Push(T * buffer)
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Buffers.push_back(buffer);
    m_Changed.notify_one();
  }

  /** Waits for a buffer; null once the channel was stopped. */
  T *
  Pop()
  {
    std::unique_lock<std::mutex> lock(m_Mutex);
    m_Changed.wait(lock, [this] { return m_IsStopped || !m_Buffers.empty(); });
    if (m_IsStopped)
    {
      return nullptr;
    }
    T * const buffer = m_Buffers.front();
    m_Buffers.pop_front();
    return buffer;
  }

  void
  Stop()
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_IsStopped = true;
    m_Changed.notify_all();
  }

private:
  std::mutex              m_Mutex;
  std::condition_variable m_Changed;
  std::deque<T *>         m_Buffers;
  bool                    m_IsStopped = false;
};

#endif
