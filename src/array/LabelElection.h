// SPDX-License-Identifier: Apache-2.0
#ifndef NonOscillatorySubdivision_LabelElection_h
#define NonOscillatorySubdivision_LabelElection_h

#include "NonOscillatorySubdivision/Kernel.h"
#include "array/LabelTypes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace itk
{
namespace Subdivision
{

/** \brief A box of voxels of a block, counted from its first voxel, without the halo. */
struct LabelBlockBox
{
  std::array<std::ptrdiff_t, 3> Begin;
  std::array<std::ptrdiff_t, 3> End;

  bool
  IsEmpty() const
  {
    return Begin[0] >= End[0] || Begin[1] >= End[1] || Begin[2] >= End[2];
  }

  void
  Include(const std::ptrdiff_t beginX, const std::ptrdiff_t endX, const std::ptrdiff_t y, const std::ptrdiff_t z)
  {
    Begin = { std::min(Begin[0], beginX), std::min(Begin[1], y), std::min(Begin[2], z) };
    End = { std::max(End[0], endX), std::max(End[1], y + 1), std::max(End[2], z + 1) };
  }
};

/** \brief The vote on the children of a block of voxels: one label after the other is subdivided by the kernel.
 *
 * Votes are computed in double, where the sums of all schemes without a tension are exact: the masks are multiples of
 * 1/1024 and P f of 1/64, along three axes. So what is a tie is one for every instruction set, and of two labels one is
 * enough. */
template <typename T>
class LabelElection
{
public:
  /** \param labels the block's voxels and their halo, x fastest
   * \param mixed which of them have a neighbour of another label: only their children are voted on
   * \param length the number of voxels along each axis, with the halo
   * \param halo along each axis
   * \param subdivided the axes that are subdivided */
  LabelElection(const std::vector<T> &             labels,
                const std::vector<std::uint8_t> &  mixed,
                const std::array<std::size_t, 3> & length,
                const std::array<int, 3> &         halo,
                const std::array<bool, 3> &        subdivided);

  /** Lets the labels vote.
   * \param reach how far from a label's voxels a child may be to be won by it
   * \param isExact whether the votes of two labels add up to 1 exactly */
  void
  Run(Kernel<double> & kernel, int reach, bool isExact);

  /** The labels of all children, x fastest. */
  const std::vector<T> &
  GetWinners() const
  {
    return m_Winners;
  }

private:
  class Indicator;
  class Counter;
  struct Candidate
  {
    T             Label;
    LabelBlockBox Box; // of all voxels of that label, the halo included
  };

  std::vector<Candidate>
  FindCandidates() const;

  /** Gives all children of the block what their parents have. */
  template <typename TValue>
  void
  GiveToChildren(const std::vector<TValue> & voxels, std::vector<TValue> & children) const;

  void
  PrepareVotes();

  /** Finds where each row of voxels has some to vote on. */
  void
  FindMixedRanges();

  /** The voxels to vote on within a box. */
  LabelBlockBox
  FindVoters(const LabelBlockBox & within) const;

  /** Voxels along x, of which none is to be voted on before the first and none after the last. */
  struct Range
  {
    std::ptrdiff_t Begin;
    std::ptrdiff_t End;
  };

  const Range &
  GetMixedRange(const std::ptrdiff_t y, const std::ptrdiff_t z) const
  {
    return m_MixedRanges[static_cast<std::size_t>(z * this->GetSize(1) + y)];
  }

  /** Of the block's first voxel along x, in row y of plane z. */
  std::size_t
  GetOffset(const std::ptrdiff_t y, const std::ptrdiff_t z) const
  {
    return static_cast<std::size_t>(((z + m_Halo[2]) * m_Length[1] + y + m_Halo[1]) * m_Length[0] + m_Halo[0]);
  }

  std::ptrdiff_t
  GetSize(const int axis) const
  {
    return m_Length[axis] - 2 * m_Halo[axis];
  }

  const std::vector<T> &            m_Labels;
  const std::vector<std::uint8_t> & m_Mixed;
  std::array<std::ptrdiff_t, 3>     m_Length;
  std::array<std::ptrdiff_t, 3>     m_Halo;
  /** 2 along axes that are subdivided, else 1. */
  std::array<std::ptrdiff_t, 3> m_Children;
  std::vector<Range>            m_MixedRanges;
  std::vector<T>                m_Winners;
  /** Of all children, the parents' labels and the winners' votes; only if there are more than two labels. */
  std::vector<T>      m_Parents;
  std::vector<double> m_Votes;
};

#define SubdivisionDeclareLabelElection(T) extern template class LabelElection<T>
SubdivisionForEachLabelType(SubdivisionDeclareLabelElection);
#undef SubdivisionDeclareLabelElection

} // namespace Subdivision
} // namespace itk

#endif
