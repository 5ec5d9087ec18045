// SPDX-License-Identifier: Apache-2.0
#ifndef ScratchPool_h
#define ScratchPool_h

#include "NonOscillatorySubdivision/Kernel.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace itk
{
namespace Subdivision
{

/** What a kernel is made for. */
struct KernelSettings
{
  const Subdivision::Scheme * Scheme;
  double                      Tension;
  Axes                        Subdivided;
  TileSize                    Largest;
  const Subdivision::Target * Target;

  /** Whether a kernel made for \c other does. */
  bool
  AreMetBy(const KernelSettings & other) const
  {
    return Scheme == other.Scheme && Tension == other.Tension && Target == other.Target &&
           Subdivided.X == other.Subdivided.X && Subdivided.Y == other.Subdivided.Y &&
           Subdivided.Z == other.Subdivided.Z && Largest.X <= other.Largest.X && Largest.Y <= other.Largest.Y &&
           Largest.Z <= other.Largest.Z;
  }
};

/** What a thread computes in. */
template <typename TReal>
struct Scratch
{
  explicit Scratch(const KernelSettings & settings)
    : Settings(settings)
  {
    if (settings.Subdivided.X || settings.Subdivided.Y || settings.Subdivided.Z)
    {
      Kernel = std::make_unique<Subdivision::Kernel<TReal>>(
        *settings.Scheme, settings.Tension, settings.Subdivided, settings.Largest, *settings.Target);
    }
  }

  KernelSettings Settings;
  /** Null where no axis is subdivided. */
  std::unique_ptr<Subdivision::Kernel<TReal>> Kernel;
  /** A row as elements and, without a kernel, as real values. */
  std::vector<unsigned char> Elements;
  std::vector<TReal>         Values;
};

/** \brief Keeps what no thread uses at the moment: as much as threads once used, so that each allocates once, even if
 * an output is computed in many runs. */
template <typename TReal>
class ScratchPool
{
public:
  /** Forgets what does not do for the run that begins, and whose settings are these. */
  void
  Prepare(const KernelSettings & settings)
  {
    m_Settings = settings;
    const auto isOfNoUse = [&settings](const Pointer & idle) { return !settings.AreMetBy(idle->Settings); };
    m_Idle.erase(std::remove_if(m_Idle.begin(), m_Idle.end(), isOfNoUse), m_Idle.end());
  }

  void
  Clear()
  {
    m_Idle.clear();
  }

private:
  using Pointer = std::unique_ptr<Scratch<TReal>>;

public:
  /** Lent to a thread for as long as this exists. */
  class Loan
  {
  public:
    explicit Loan(ScratchPool & pool)
      : m_Pool(pool)
      , m_Scratch(pool.Take())
    {}
    ~Loan() { m_Pool.Return(std::move(m_Scratch)); }
    Loan(const Loan &) = delete;
    Loan &
    operator=(const Loan &) = delete;

    Scratch<TReal> *
    operator->() const
    {
      return m_Scratch.get();
    }

  private:
    ScratchPool & m_Pool;
    Pointer       m_Scratch;
  };

private:
  Pointer
  Take()
  {
    Pointer scratch = this->TakeIdle();
    if (!scratch)
    {
      scratch = std::make_unique<Scratch<TReal>>(m_Settings);
      const std::lock_guard<std::mutex> lock(m_Mutex);
      // Giving back must not throw: there is room for all that is idle or lent.
      m_Idle.reserve(m_Idle.size() + m_Lent + 1);
      ++m_Lent;
    }
    return scratch;
  }

  Pointer
  TakeIdle()
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    if (m_Idle.empty())
    {
      return nullptr;
    }
    Pointer scratch = std::move(m_Idle.back());
    m_Idle.pop_back();
    ++m_Lent;
    return scratch;
  }

  void
  Return(Pointer scratch)
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Idle.push_back(std::move(scratch));
    --m_Lent;
  }

  KernelSettings       m_Settings{};
  std::vector<Pointer> m_Idle;
  std::size_t          m_Lent{ 0 };
  std::mutex           m_Mutex;
};

} // namespace Subdivision
} // namespace itk

#endif
