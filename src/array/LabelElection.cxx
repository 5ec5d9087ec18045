// SPDX-License-Identifier: Apache-2.0
#include "array/LabelElection.h"

#include <limits>

namespace itk
{
namespace Subdivision
{
namespace
{

constexpr LabelBlockBox Nowhere{ { PTRDIFF_MAX, PTRDIFF_MAX, PTRDIFF_MAX }, { PTRDIFF_MIN, PTRDIFF_MIN, PTRDIFF_MIN } };

} // namespace

/** 1 where a voxel has a label, else 0. */
template <typename T>
class LabelElection<T>::Indicator : public RowSource<double>
{
public:
  Indicator(const LabelElection & election, const T label, const LabelBlockBox & box)
    : m_Election(election)
    , m_Label(label)
    , m_Box(box)
  {}

  void
  ReadRow(const std::ptrdiff_t y, const std::ptrdiff_t z, double * const values) override
  {
    const std::ptrdiff_t halo = m_Election.m_Halo[0];
    const T * const      labels =
      m_Election.m_Labels.data() + m_Election.GetOffset(m_Box.Begin[1] + y, m_Box.Begin[2] + z) + m_Box.Begin[0] - halo;
    const std::ptrdiff_t count = m_Box.End[0] - m_Box.Begin[0] + 2 * halo;
    for (std::ptrdiff_t x = 0; x < count; ++x)
    {
      values[x] = labels[x] == m_Label ? 1.0 : 0.0;
    }
  }

private:
  const LabelElection & m_Election;
  const T               m_Label;
  const LabelBlockBox   m_Box;
};

/** Counts the votes of one label, or of one label against the only other one. */
template <typename T>
class LabelElection<T>::Counter : public RowSink<double>
{
public:
  Counter(LabelElection & election, const T label, const T * const onlyOther, const LabelBlockBox & box)
    : m_Election(election)
    , m_Label(label)
    , m_OnlyOther(onlyOther)
    , m_Box(box)
  {}

  void
  WriteRow(const std::ptrdiff_t y, const std::ptrdiff_t z, const ChildRow<double> & children) override
  {
    const auto &         perVoxel = m_Election.m_Children;
    const std::ptrdiff_t childY = perVoxel[1] * m_Box.Begin[1] + y;
    const std::ptrdiff_t childZ = perVoxel[2] * m_Box.Begin[2] + z;
    const Range          mixed = m_Election.GetMixedRange(childY / perVoxel[1], childZ / perVoxel[2]);
    const std::ptrdiff_t begin = std::max(mixed.Begin, m_Box.Begin[0]);
    const std::ptrdiff_t end = std::min(mixed.End, m_Box.End[0]);
    if (begin >= end)
    {
      return;
    }
    m_Row.resize(children.GetSize());
    children.CopyTo(ElementType::Double, m_Row.data());
    const double * const votes = m_Row.data() + perVoxel[0] * (begin - m_Box.Begin[0]);
    const std::ptrdiff_t first =
      ((childZ * perVoxel[1] * m_Election.GetSize(1) + childY) * m_Election.GetSize(0) + begin) * perVoxel[0];
    const std::ptrdiff_t count = perVoxel[0] * (end - begin);
    if (m_OnlyOther != nullptr)
    {
      this->CountDuel(votes, first, count);
    }
    else
    {
      this->Count(votes, first, count);
    }
  }

private:
  /** Of two labels, the one with more than half of the vote wins; otherwise the parent's label, which stands there. */
  void
  CountDuel(const double * const votes, const std::ptrdiff_t first, const std::ptrdiff_t count)
  {
    T * const winners = m_Election.m_Winners.data() + first;
    const T   label = m_Label;
    const T   other = *m_OnlyOther;
    for (std::ptrdiff_t x = 0; x < count; ++x)
    {
      const double vote = votes[x];
      winners[x] = vote > 0.5 ? label : vote < 0.5 ? other : winners[x];
    }
  }

  /** Labels come in ascending order: a later one needs more, or to be the parent's. */
  void
  Count(const double * const votes, const std::ptrdiff_t first, const std::ptrdiff_t count)
  {
    T * const       winners = m_Election.m_Winners.data() + first;
    const T * const parents = m_Election.m_Parents.data() + first;
    double * const  most = m_Election.m_Votes.data() + first;
    for (std::ptrdiff_t x = 0; x < count; ++x)
    {
      const double vote = votes[x];
      if (vote > most[x] || (vote == most[x] && parents[x] == m_Label))
      {
        most[x] = vote;
        winners[x] = m_Label;
      }
    }
  }

  LabelElection &     m_Election;
  const T             m_Label;
  const T * const     m_OnlyOther;
  const LabelBlockBox m_Box;
  std::vector<double> m_Row;
};

template <typename T>
LabelElection<T>::LabelElection(const std::vector<T> &             labels,
                                const std::vector<std::uint8_t> &  mixed,
                                const std::array<std::size_t, 3> & length,
                                const std::array<int, 3> &         halo,
                                const std::array<bool, 3> &        subdivided)
  : m_Labels(labels)
  , m_Mixed(mixed)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    m_Length[axis] = static_cast<std::ptrdiff_t>(length[axis]);
    m_Halo[axis] = halo[axis];
    m_Children[axis] = subdivided[axis] ? Children : 1;
  }
  // Until a label wins, a child has its parent's. A vote of 0 wins nothing: labels beyond the stencil have it.
  this->GiveToChildren(labels, m_Winners);
}

template <typename T>
template <typename TValue>
void
LabelElection<T>::GiveToChildren(const std::vector<TValue> & voxels, std::vector<TValue> & children) const
{
  const std::ptrdiff_t width = m_Children[0] * this->GetSize(0);
  children.resize(
    static_cast<std::size_t>(width * m_Children[1] * this->GetSize(1) * m_Children[2] * this->GetSize(2)));
  TValue * row = children.data();
  for (std::ptrdiff_t z = 0; z < m_Children[2] * this->GetSize(2); ++z)
  {
    for (std::ptrdiff_t y = 0; y < m_Children[1] * this->GetSize(1); ++y, row += width)
    {
      const TValue * const parents = voxels.data() + this->GetOffset(y / m_Children[1], z / m_Children[2]);
      if (m_Children[0] == 1)
      {
        std::copy_n(parents, width, row);
        continue;
      }
      for (std::ptrdiff_t x = 0; x < width / Children; ++x)
      {
        row[Children * x] = parents[x];
        row[Children * x + 1] = parents[x];
      }
    }
  }
}

template <typename T>
auto
LabelElection<T>::FindCandidates() const -> std::vector<Candidate>
{
  std::vector<Candidate> candidates;
  std::size_t            found = 0;
  const auto include = [&](const T label, const std::ptrdiff_t begin, const std::ptrdiff_t end, auto y, auto z) {
    if (found >= candidates.size() || candidates[found].Label != label)
    {
      const auto place = std::lower_bound(
        candidates.begin(), candidates.end(), label, [](const Candidate & a, const T b) { return a.Label < b; });
      found = static_cast<std::size_t>(place - candidates.begin());
      if (place == candidates.end() || place->Label != label)
      {
        candidates.insert(place, { label, Nowhere });
      }
    }
    candidates[found].Box.Include(begin, end, y, z);
  };
  for (std::ptrdiff_t z = -m_Halo[2]; z < this->GetSize(2) + m_Halo[2]; ++z)
  {
    for (std::ptrdiff_t y = -m_Halo[1]; y < this->GetSize(1) + m_Halo[1]; ++y)
    {
      const T * const      row = m_Labels.data() + this->GetOffset(y, z);
      const std::ptrdiff_t end = this->GetSize(0) + m_Halo[0];
      for (std::ptrdiff_t x = -m_Halo[0]; x < end;)
      {
        const std::ptrdiff_t begin = x;
        while (x < end && row[x] == row[begin])
        {
          ++x;
        }
        include(row[begin], begin, x, y, z);
      }
    }
  }
  return candidates;
}

template <typename T>
void
LabelElection<T>::FindMixedRanges()
{
  for (std::ptrdiff_t z = 0; z < this->GetSize(2); ++z)
  {
    for (std::ptrdiff_t y = 0; y < this->GetSize(1); ++y)
    {
      const std::uint8_t * const row = m_Mixed.data() + this->GetOffset(y, z);
      const auto * const         begin = std::find(row, row + this->GetSize(0), 1);
      const auto *               end = row + this->GetSize(0);
      while (end > begin && end[-1] == 0)
      {
        --end;
      }
      m_MixedRanges.push_back({ begin - row, end - row });
    }
  }
}

template <typename T>
LabelBlockBox
LabelElection<T>::FindVoters(const LabelBlockBox & within) const
{
  LabelBlockBox voters = Nowhere;
  for (std::ptrdiff_t z = within.Begin[2]; z < within.End[2]; ++z)
  {
    for (std::ptrdiff_t y = within.Begin[1]; y < within.End[1]; ++y)
    {
      const Range          mixed = this->GetMixedRange(y, z);
      const std::ptrdiff_t begin = std::max(mixed.Begin, within.Begin[0]);
      const std::ptrdiff_t end = std::min(mixed.End, within.End[0]);
      if (begin < end)
      {
        voters.Include(begin, end, y, z);
      }
    }
  }
  return voters;
}

template <typename T>
void
LabelElection<T>::PrepareVotes()
{
  m_Parents = m_Winners;
  std::vector<std::uint8_t> mixed;
  this->GiveToChildren(m_Mixed, mixed);
  m_Votes.resize(mixed.size());
  // Nothing wins a child that is not voted on: its own label may not have been asked.
  std::transform(mixed.begin(), mixed.end(), m_Votes.begin(), [](const std::uint8_t isMixed) {
    return isMixed ? 0.0 : std::numeric_limits<double>::infinity();
  });
}

template <typename T>
void
LabelElection<T>::Run(Kernel<double> & kernel, const int reach, const bool isExact)
{
  this->FindMixedRanges();
  const std::vector<Candidate> candidates = this->FindCandidates();
  const bool                   isDuel = isExact && candidates.size() == 2;
  if (!isDuel)
  {
    this->PrepareVotes();
  }
  for (std::size_t number = 0; number < (isDuel ? 1 : candidates.size()); ++number)
  {
    LabelBlockBox within = candidates[number].Box;
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::ptrdiff_t far = m_Children[axis] > 1 ? reach : 0;
      within.Begin[axis] = isDuel ? 0 : std::max<std::ptrdiff_t>(within.Begin[axis] - far, 0);
      within.End[axis] = isDuel ? this->GetSize(axis) : std::min(within.End[axis] + far, this->GetSize(axis));
    }
    const LabelBlockBox voters = this->FindVoters(within);
    if (!voters.IsEmpty())
    {
      const auto size = [&](const int axis) { return static_cast<std::size_t>(voters.End[axis] - voters.Begin[axis]); };
      Indicator  indicator(*this, candidates[number].Label, voters);
      Counter    counter(*this, candidates[number].Label, isDuel ? &candidates[1].Label : nullptr, voters);
      kernel.Subdivide({ size(0), size(1), size(2) }, indicator, counter);
    }
  }
}

#define SubdivisionInstantiateLabelElection(T) template class LabelElection<T>
SubdivisionForEachLabelType(SubdivisionInstantiateLabelElection);
#undef SubdivisionInstantiateLabelElection

} // namespace Subdivision
} // namespace itk
