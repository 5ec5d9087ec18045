// SPDX-License-Identifier: Apache-2.0
#ifndef PythonMonitor_h
#define PythonMonitor_h

#include "NonOscillatorySubdivision/Subdivider.h"

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <thread>
#include <utility>

/** \brief Lets the interpreter in now and then while the tiles of a run are computed without its lock: for Ctrl-C, and
 * to say how far the run is.
 *
 * The thread that made the monitor must compute tiles, too: it is the one that asks. */
class PythonMonitor : public itk::Subdivision::TileMonitor
{
public:
  /** \param progress is called with a number that grows from \c begin to \c end; or None
   * \param elements of the output */
  PythonMonitor(nanobind::object progress, double begin, double end, std::size_t elements)
    : m_Progress(std::move(progress))
    , m_Begin(begin)
    , m_End(end)
    , m_Elements(elements)
  {}

  /** \throw nanobind::python_error in the thread that made the monitor, if Ctrl-C was pressed or the callable raised
   * \throw std::runtime_error in the others, which end then, too, in the middle of their tiles */
  void
  Completed(std::size_t elements) override
  {
    const std::size_t completed = m_Completed += elements;
    if (std::this_thread::get_id() != m_Caller)
    {
      if (m_IsStopped)
      {
        throw std::runtime_error("stopped by the caller");
      }
    }
    else if (Clock::now() >= m_NextTime)
    {
      try
      {
        AskInterpreter(completed);
      }
      catch (...)
      {
        m_IsStopped = true;
        throw;
      }
      m_NextTime = Clock::now() + std::chrono::milliseconds(20);
    }
  }

  bool
  IsStopped() const override
  {
    return m_IsStopped;
  }

private:
  using Clock = std::chrono::steady_clock;

  void
  AskInterpreter(const std::size_t completed)
  {
    const nanobind::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0)
    {
      throw nanobind::python_error();
    }
    if (!m_Progress.is_none())
    {
      m_Progress(m_Begin + (m_End - m_Begin) * static_cast<double>(completed) / static_cast<double>(m_Elements));
    }
  }

  const nanobind::object   m_Progress;
  const double             m_Begin;
  const double             m_End;
  const std::size_t        m_Elements;
  const std::thread::id    m_Caller = std::this_thread::get_id();
  std::atomic<std::size_t> m_Completed{ 0 };
  std::atomic<bool>        m_IsStopped{ false };
  Clock::time_point        m_NextTime = Clock::now() + std::chrono::milliseconds(20);
};

#endif
