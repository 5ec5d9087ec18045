// SPDX-License-Identifier: Apache-2.0
#ifndef itkRadixQuantiles_h
#define itkRadixQuantiles_h

#include "itkIntTypes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace itk
{
/** \class RadixQuantiles
 * \brief Exact quantiles of non-negative numbers that are shown four times and never stored.
 *
 * Non-negative doubles are ordered as their bit patterns are. Each pass counts the next 16 bits ("digit") of those
 * numbers whose higher bits are the ones of a sought order statistic, so that after four passes all 64 bits of it are
 * known. Only counts are kept: 512 KiB for every different prefix under search, at most two a quantile.
 * Counts add up to the same in every order, so the work may be divided between threads in any way.
 *
 * The quantile at level \f$q\f$ of \f$n\f$ sorted numbers \f$x_0 \le \dots \le x_{n-1}\f$ is interpolated between
 * the neighbours of position \f$q (n - 1)\f$; the median of an even number of numbers is the mean of the middle two.
 *
 * In every pass: MakeCounts() (for each thread), Count() for every number, Merge() the counts, FinishPass().
 * The numbers must be the same in each pass (in any order), none of them negative or NaN; infinity is allowed.
 *
 * \ingroup NonOscillatorySubdivision
 */
class RadixQuantiles
{
public:
  using Counts = std::vector<SizeValueType>;

  static constexpr unsigned int NumberOfPasses = 4;

  /** \param levels of the quantiles, each in [0, 1]. */
  explicit RadixQuantiles(std::vector<double> levels = {})
    : m_Levels(std::move(levels))
    , m_Counts(this->MakeCounts())
  {}

  /** Counts of zero, for the current pass. */
  Counts
  MakeCounts() const
  {
    return Counts(m_Prefixes.size() * NumberOfDigits);
  }

  /** Counts \a value where the current pass looks at it. */
  void
  Count(double value, Counts & counts) const
  {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    const std::uint64_t known = bits >> (BitsPerDigit * (NumberOfPasses - 1 - m_Pass));
    const auto          prefix = std::find(m_Prefixes.begin(), m_Prefixes.end(), known >> BitsPerDigit);
    if (prefix != m_Prefixes.end())
    {
      ++counts[(prefix - m_Prefixes.begin()) * NumberOfDigits + known % NumberOfDigits];
    }
  }

  /** Adds the counts of one thread. Not to be called from two threads at a time. */
  void
  Merge(const Counts & counts)
  {
    std::transform(counts.begin(), counts.end(), m_Counts.begin(), m_Counts.begin(), std::plus<>());
  }

  void
  FinishPass()
  {
    if (m_Pass == 0)
    {
      this->MakeOrderStatistics();
    }
    for (OrderStatistic & statistic : m_OrderStatistics)
    {
      this->FindNextDigit(statistic);
    }
    m_Prefixes.clear();
    for (const OrderStatistic & statistic : m_OrderStatistics)
    {
      m_Prefixes.push_back(statistic.prefix);
    }
    std::sort(m_Prefixes.begin(), m_Prefixes.end());
    m_Prefixes.erase(std::unique(m_Prefixes.begin(), m_Prefixes.end()), m_Prefixes.end());
    m_Counts = ++m_Pass < NumberOfPasses ? this->MakeCounts() : Counts();
  }

  /** The quantiles, in the order of the levels, after the last pass. NaN where there were no numbers. */
  std::vector<double>
  GetQuantiles() const
  {
    std::vector<double> quantiles(m_Levels.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < quantiles.size() && !m_OrderStatistics.empty(); ++i)
    {
      const double lower = ToDouble(m_OrderStatistics[2 * i].prefix);
      const double upper = ToDouble(m_OrderStatistics[2 * i + 1].prefix);
      const double position = this->GetPosition(m_Levels[i]);
      const double fraction = position - std::floor(position);
      // Equal neighbours are returned untouched: infinity has no difference to interpolate.
      quantiles[i] = lower == upper || fraction == 0.0 ? lower : lower + fraction * (upper - lower);
    }
    return quantiles;
  }

  /** How many numbers the first pass counted. */
  SizeValueType
  GetNumberOfValues() const
  {
    return m_NumberOfValues;
  }

private:
  static constexpr unsigned int  BitsPerDigit = 16;
  static constexpr std::uint64_t NumberOfDigits = std::uint64_t{ 1 } << BitsPerDigit;

  struct OrderStatistic
  {
    SizeValueType rank;   // among the numbers that begin with the prefix, from 0
    std::uint64_t prefix; // the digits known so far
  };

  static double
  ToDouble(std::uint64_t bits)
  {
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

  double
  GetPosition(double level) const
  {
    return level * static_cast<double>(m_NumberOfValues - 1);
  }

  void
  MakeOrderStatistics()
  {
    m_NumberOfValues = std::accumulate(m_Counts.begin(), m_Counts.end(), SizeValueType{ 0 });
    if (m_NumberOfValues == 0)
    {
      return;
    }
    for (const double level : m_Levels)
    {
      const auto lower = static_cast<SizeValueType>(this->GetPosition(level));
      m_OrderStatistics.push_back({ lower, 0 });
      m_OrderStatistics.push_back({ std::min(lower + 1, m_NumberOfValues - 1), 0 });
    }
  }

  void
  FindNextDigit(OrderStatistic & statistic) const
  {
    const auto                  prefix = std::find(m_Prefixes.begin(), m_Prefixes.end(), statistic.prefix);
    const SizeValueType * const counts = &m_Counts[(prefix - m_Prefixes.begin()) * NumberOfDigits];
    std::uint64_t               digit = 0;
    while (statistic.rank >= counts[digit])
    {
      statistic.rank -= counts[digit];
      ++digit;
    }
    statistic.prefix = statistic.prefix << BitsPerDigit | digit;
  }

  std::vector<double>         m_Levels;
  unsigned int                m_Pass{ 0 };
  SizeValueType               m_NumberOfValues{ 0 };
  std::vector<std::uint64_t>  m_Prefixes{ 0 }; // without repetition; in the first pass the empty one
  std::vector<OrderStatistic> m_OrderStatistics{};
  Counts                      m_Counts;
};
} // end namespace itk

#endif
