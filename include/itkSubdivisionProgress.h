// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionProgress_h
#define itkSubdivisionProgress_h

#include "NonOscillatorySubdivision/TileRun.h"

#include "itkMultiThreaderBase.h"
#include "itkProcessObject.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

namespace itk
{
namespace Detail
{

/** \class SubdivisionProgress
 *
 * \brief Runs the tiles of a filter on its threader, while the thread that updates the
 * filter, the only one that may tell observers, reports progress and hears of an abort.
 *
 * That thread computes no tile where there are several work units: it would have to wait for the end of its tile, and
 * some threaders begin its work unit when the others have done all of it.
 *
 * \ingroup NonOscillatorySubdivision
 */
class SubdivisionProgress : private Subdivision::TileMonitor
{
public:
  /** \param filter the filter, whose progress goes from 0 to 1
   * \param elements how many elements are computed in all */
  SubdivisionProgress(ProcessObject * filter, const std::size_t elements)
    : m_Filter(filter)
    , m_Elements(elements)
    , m_UpdatingThread(std::this_thread::get_id())
    , m_HasObserver(filter->HasObserver(ProgressEvent()))
  {}

  /** Computes all tiles of a run.
   * \throw ProcessAborted, or the first exception of any thread or observer */
  void
  RunTiles(Subdivision::TileRun & run, MultiThreaderBase * const threader, const SizeValueType workUnits)
  {
    const std::size_t        tiles = run.GetNumberOfTiles();
    std::atomic<std::size_t> next{ 0 };
    const auto               work = [&](SizeValueType) {
      this->StopAtException([&] {
        for (std::size_t tile = next++; tile < tiles && !this->IsStopped(); tile = next++)
        {
          run.ComputeTile(tile, *this);
        }
      });
    };
    const SizeValueType units = std::min<SizeValueType>(workUnits, tiles);
    if (units > 1)
    {
      this->RunBesides([&] {
        this->StopAtException([&] { threader->ParallelizeArray(0, units, work, nullptr); });
        this->Finish();
      });
    }
    else
    {
      work(0);
    }
    this->StopAtException([&] { this->Report(); });
    if (m_FirstException)
    {
      std::rethrow_exception(m_FirstException);
    }
  }

private:
  /** Until an abort by somebody who is no observer is heard of. */
  static constexpr std::chrono::milliseconds LongestDelay{ 20 };
  static constexpr std::size_t               Reports = 100;

  /** Runs a function that ends with Finish() in a thread of its own, and reports meanwhile. */
  template <typename TFunction>
  void
  RunBesides(const TFunction & function)
  {
    std::thread besides;
    try
    {
      besides = std::thread(function);
    }
    catch (const std::system_error &)
    {
      // Without one more thread it is done here, and progress is told of at the end.
      function();
      return;
    }
    std::unique_lock<std::mutex> lock(m_Mutex);
    while (!m_IsFinished)
    {
      m_Changed.wait_for(lock, LongestDelay);
      lock.unlock();
      this->StopAtException([&] { this->Report(); });
      lock.lock();
    }
    lock.unlock();
    besides.join();
  }

  void
  Completed(const std::size_t elements) override
  {
    const std::size_t before = m_Done.fetch_add(elements);
    if (std::this_thread::get_id() == m_UpdatingThread)
    {
      this->Report();
    }
    else if (m_HasObserver && this->GetStep(before) != this->GetStep(before + elements))
    {
      m_Changed.notify_one();
    }
    if (m_IsStopped)
    {
      throw ProcessAborted(__FILE__, __LINE__);
    }
  }

  bool
  IsStopped() const override
  {
    return m_IsStopped;
  }

  std::size_t
  GetStep(const std::size_t elements) const
  {
    return static_cast<std::size_t>(static_cast<double>(elements) / static_cast<double>(m_Elements) * Reports);
  }

  /** In the updating thread: tells observers if there is something to tell, and hears of an abort. */
  void
  Report()
  {
    const std::size_t done = m_Done;
    if (!m_IsStopped && this->GetStep(done) != m_ReportedStep)
    {
      m_ReportedStep = this->GetStep(done);
      m_Filter->UpdateProgress(static_cast<float>(static_cast<double>(done) / static_cast<double>(m_Elements)));
    }
    if (!m_IsStopped && m_Filter->GetAbortGenerateData())
    {
      ProcessAborted aborted(__FILE__, __LINE__);
      aborted.SetDescription("The filter was aborted by a user's request");
      throw aborted;
    }
  }

  void
  Finish()
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_IsFinished = true;
    m_Changed.notify_one();
  }

  /** Keeps the first exception of a function, and the threads from beginning another tile. */
  template <typename TFunction>
  void
  StopAtException(const TFunction & function)
  {
    try
    {
      function();
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(m_Mutex);
      m_FirstException = m_FirstException ? m_FirstException : std::current_exception();
      m_IsStopped = true;
    }
  }

  ProcessObject * m_Filter;
  std::size_t     m_Elements;
  std::thread::id m_UpdatingThread;
  /** Whether anybody waits to be told. Waking the updating thread for nobody takes the threads that compute off theirs.
   */
  bool                     m_HasObserver;
  std::atomic<std::size_t> m_Done{ 0 };
  std::size_t              m_ReportedStep{ 0 };
  std::atomic<bool>        m_IsStopped{ false };
  std::exception_ptr       m_FirstException;
  bool                     m_IsFinished{ false };
  std::mutex               m_Mutex;
  std::condition_variable  m_Changed;
};

} // namespace Detail
} // namespace itk

#endif
