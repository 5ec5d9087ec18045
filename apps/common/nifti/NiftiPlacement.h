// SPDX-License-Identifier: Apache-2.0
#ifndef NiftiPlacement_h
#define NiftiPlacement_h

#include "volumes/ImageDescription.h"

#include <array>
#include <cstddef>
#include <string>

/** Where a NIfTI header places the voxels in space: by a quaternion (qform), by a matrix (sform), by both or not at
 * all.
 */
class NiftiPlacement
{
public:
  using Matrix = std::array<std::array<double, 4>, 3>;

  /** What the header says of it. */
  struct Numbers
  {
    bool                  HasQuaternion = false;
    bool                  HasMatrix = false;
    std::array<double, 6> Quaternion{}; // b, c and d, then the offsets
    Matrix                Rows{};
    std::size_t           Axes = 3;   // of the image, in space
    double                Sign = 1.0; // of the third axis of the quaternion
    std::array<double, 3> Spacing{};
    std::array<double, 3> Size{};
  };

  explicit NiftiPlacement(const Numbers & numbers)
    : m_Numbers(numbers)
  {}

  bool
  IsThere() const
  {
    return m_Numbers.HasQuaternion || m_Numbers.HasMatrix;
  }

  /** Whether its numbers are finite: ITK ends the program over others. */
  bool
  IsFinite() const;

  /** Whether there are two that differ. */
  bool
  IsTwice() const;

  /** Which of the two, qform or sform, a grid has. */
  const char *
  GetName(const ImageGrid & grid) const;

  /** Whether the axes of an image that has one or two leave the line or the plane of the first coordinates. Then the
   * grid of the image cannot have their directions. */
  bool
  LeavesAxes(std::size_t axes) const;

  /** Whether an image of one or two axes lies beside that line or plane. */
  bool
  LiesBeside(std::size_t axes) const;

  /** Why its voxels' lengths are wrong: one is negative, or a matrix that is the only placement has others; empty if
   * they are not. */
  std::string
  FindFault() const;

  /** Why ITK finds no directions of axes in it, and what to do. */
  std::string
  ExplainRefusal() const;

private:
  Matrix
  GetQuaternionMatrix() const;
  std::array<double, 3>
  GetMatrixSpacing() const;
  template <typename TTest>
  bool
  IsTrueOfAny(TTest && test) const;

  Numbers m_Numbers;
};

#endif
