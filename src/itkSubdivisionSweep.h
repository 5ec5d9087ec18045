// SPDX-License-Identifier: Apache-2.0
#ifndef itkSubdivisionSweep_h
#define itkSubdivisionSweep_h

#include "itkSubdivisionKernel.h"

#include <cstddef>
#include <cstdint>

namespace itk
{

/** The last few planes or rows of a sweep; entry 0 is the newest. */
template <typename T, int VLength>
struct SubdivisionRing
{
  static constexpr int Length = VLength;
  T *                  Entry[VLength];

  T *
  operator[](int age) const
  {
    return Entry[age];
  }

  /** Makes room for a new entry, where the oldest one was. */
  void
  Rotate()
  {
    T * const oldest = Entry[VLength - 1];
    for (int age = VLength - 1; age > 0; --age)
    {
      Entry[age] = Entry[age - 1];
    }
    Entry[0] = oldest;
  }
};

/** What windows of five planes, of which every second one begins a pair, need to know of the last four: the minima of
 * either pair, and the later plane of either. Entry 0 is the newer pair. */
template <typename T>
struct SubdivisionPlaneWindow
{
  SubdivisionRing<T, 2> Pair;
  SubdivisionRing<T, 2> Later;
};

/** The subsets of the axes {lane, row} that a field belongs to, as bits. */
enum SubdivisionAxesInPlane
{
  NoAxisInPlane = 0,
  LaneAxis = 1,
  RowAxis = 2,
  BothAxesInPlane = LaneAxis | RowAxis,
  SubsetsInPlane = 4
};

/** All that a sweep through a tile keeps, as plain data that the code of every target can use.
 *
 * Planes and rows are addressed by their voxel (0, 0) or 0; row r of a plane begins r * Pitch further on.
 * A field of the scheme (docs/scheme.md, section 3) belongs to a subset A of the axes; "flat" fields are those whose
 * subset lacks the sweep axis, "steep" ones those whose subset has it. */
template <typename T>
struct SubdivisionSweep
{
  static constexpr int PlanesPerStep = SubdivisionKernel<T>::PlanesPerStep;
  static constexpr int ThresholdedInputs = 6;
  // The stencils of the planes of a step.
  static constexpr int ValuePlanes = 7 + PlanesPerStep - 1;
  static constexpr int SecondDifferencePlanes = 5 + PlanesPerStep - 1;
  static constexpr int NeighbourPlanes = 5 + PlanesPerStep - 1;
  /** Rows that are limited before they are filtered. Few, so that the cache still holds them; not one by one, or what
   * either step keeps from row to row would leave the first-level cache. */
  static constexpr std::ptrdiff_t RowsPerStep = 16;
  /** A power of two that holds the rows of a step and those before them that it still needs. */
  static constexpr std::ptrdiff_t LimitedRows = 2 * RowsPerStep;

  NonOscillatorySubdivisionImageFilterEnums::Scheme Scheme;

  double         Tension;
  bool           HasRowAxis;
  bool           HasSweepAxis;
  std::ptrdiff_t Width;
  std::ptrdiff_t Height;
  std::ptrdiff_t Pitch;

  /** Planes taken since the tile began, and planes that the tile needs, with its halo. */
  std::ptrdiff_t Planes;
  std::ptrdiff_t EndPlanes;

  /** The steep fields are computed for two planes at a time, and the last plane of a tile completes a pair; if their
   * number is odd, the first one does so, too. */
  bool
  IsPairComplete() const
  {
    return (EndPlanes - Planes) % 2 == 0;
  }

  /** The input planes; the caller writes entry 0. */
  SubdivisionRing<T, ThresholdedInputs> Input;

  /** Children across rows of the flat and of the steep fields, by [child across rows][sums of the fields without and
   * with the lane axis]. */
  SubdivisionRing<T, ValuePlanes>            FlatChildren[2][2];
  SubdivisionRing<T, SecondDifferencePlanes> SteepChildren[2][2];

  /** Limited fields, by [plane: earlier, later][subset in plane]; only the steep ones need two planes, and the flat
   * field of no axis is the input itself. */
  T * Limited[2][SubsetsInPlane];

  /** The part of the steep fields' block sums in the latest slope, by [subset in plane] but for that of no axis. */
  T * KeptSlopeSums[SubsetsInPlane];
  /** Windows of the steep fields' block sums along the sweep, by [subset in plane]. */
  SubdivisionPlaneWindow<T> SteepWindows[SubsetsInPlane];

  /** Smallest and largest value of the neighbours in the plane (bounded linear scheme). */
  SubdivisionRing<T, NeighbourPlanes> SmallestNeighbour;
  SubdivisionRing<T, NeighbourPlanes> LargestNeighbour;

  /** Rows that live while one plane is processed. */
  struct RowBuffers
  {
    // By [plane: earlier, later], where only the steep fields need two.
    /** Differences between the newest input planes. */
    SubdivisionRing<T, 2> Slope[2];
    /** The part of the block sums in the latest difference of rows. */
    T * KeptRowSums[2];
    T * KeptBothSums[2];
    /** Block sums of the subsets without the row axis, with it, and with both; for windows across rows, of the last
     * rows, with their minima along the lanes if the subset has that axis, too. */
    T *                   LaneSums[2];
    SubdivisionRing<T, 5> RowSums[2];
    T *                   BothSums[2];
    SubdivisionRing<T, 5> BothMinima[2];
    /** Second differences along the sweep, and along rows of those or of the values. */
    SubdivisionRing<T, 5> SweepCurvature[2];
    T *                   RowCurvature[2];
    /** Smallest and largest neighbour along the lanes. */
    SubdivisionRing<T, 3> Smallest;
    SubdivisionRing<T, 3> Largest;
  } Rows;

  /** Of one row of children across rows, the children across planes, by [age of the plane][child along the
   * sweep][sums of the fields without and with the lane axis]. */
  T * SweepChildren[PlanesPerStep][2][2];
  /** Smallest and largest neighbour of the voxels of that row, by [age of the plane]. */
  T * SmallestOfRow[PlanesPerStep];
  T * LargestOfRow[PlanesPerStep];

  /** Of one row of children across planes, both children of every voxel along the lanes: a vector of lower ones and a
   * vector of upper ones in turns. */
  T * Children;
};

/** What one instruction set offers: the steps of a sweep and the conversions of pixels. */
template <typename T>
struct SubdivisionSweepSteps
{
  void (*AdvancePlane)(SubdivisionSweep<T> &);
  void (*ComputeRow)(const SubdivisionSweep<T> &, std::ptrdiff_t row, int rowChild, int planes);
  void (*ComputeChildren)(const SubdivisionSweep<T> &, int age, int sweepChild);
};

template <typename TPixel>
struct SubdivisionConversion
{
  void (*ConvertRow)(const TPixel *, std::size_t, float *);
  void (*InterleaveChildren)(const float *, std::size_t, TPixel *);
};

struct SubdivisionTarget
{
  const char *                         Name;
  SubdivisionSweepSteps<float>         Float;
  SubdivisionSweepSteps<double>        Double;
  SubdivisionConversion<std::uint8_t>  UInt8;
  SubdivisionConversion<std::int8_t>   Int8;
  SubdivisionConversion<std::uint16_t> UInt16;
  SubdivisionConversion<std::int16_t>  Int16;
  SubdivisionConversion<float>         Real;

  void (*InterleaveDoubles)(const double *, std::size_t, double *);
};

/** The target that needs nothing but C++. */
const SubdivisionTarget &
GetPortableSubdivisionTarget();

/** The vectorised targets that this processor supports, the fastest first. Returns how many were written. */
int
GetVectorisedSubdivisionTargets(const SubdivisionTarget ** targets, int maximum);

} // namespace itk

#endif
