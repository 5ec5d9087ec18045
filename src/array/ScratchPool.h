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
    , Kernel(*settings.Scheme, settings.Tension, settings.Subdivided, settings.Largest, *settings.Target)
  {}

  KernelSettings             Settings;
  Subdivision::Kernel<TReal> Kernel;
  std::vector<unsigned char> Row;
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
    {
      const std::lock_guard<std::mutex> lock(m_Mutex);
      if (!m_Idle.empty())
      {
        Pointer scratch = std::move(m_Idle.back());
        m_Idle.pop_back();
        return scratch;
      }
      // Giving it back must not throw.
      m_Idle.reserve(++m_Number);
    }
    return std::make_unique<Scratch<TReal>>(m_Settings);
  }

  void
  Return(Pointer scratch)
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Idle.push_back(std::move(scratch));
  }

  KernelSettings       m_Settings{};
  std::vector<Pointer> m_Idle;
  std::size_t          m_Number{ 0 };
  std::mutex           m_Mutex;
};

} // namespace Subdivision
} // namespace itk

#endif
