// SPDX-License-Identifier: Apache-2.0
#ifndef Sweep_h
#define Sweep_h

#include "NonOscillatorySubdivision/Kernel.h"

#include <array>
#include <cstddef>

namespace itk
{
namespace Subdivision
{

/** What a sweep is made for. */
struct SweepSettings
{
  Subdivision::Scheme         Scheme;
  double                      Tension;
  Axes                        Subdivided;
  std::size_t                 LargestWidth;
  std::size_t                 LargestHeight;
  const Subdivision::Target * Target;
};

/** \brief A kernel's work, compiled for a target: goes through a tile from plane to plane.
 *
 * Along x, voxels may be carried. y is subdivided only if z is; where one of them is not, its size is 1. */
template <typename T>
class Sweep
{
public:
  virtual ~Sweep() = default;
  virtual void
  Subdivide(const TileSize & tile, RowSource<T> & source, RowSink<T> & sink) = 0;
};

/** What a target makes and does, for one real type; conversions by the type of the elements. */
template <typename T>
struct TargetFunctions
{
  using FromElements = void (*)(const void *, std::size_t, T *);
  using ToElements = void (*)(const T *, std::size_t, void *);

  Sweep<T> * (*MakeSweep)(const SweepSettings &);
  std::array<FromElements, NumberOfElementTypes> Widen;
  std::array<ToElements, NumberOfElementTypes>   Narrow;
  std::array<ToElements, NumberOfElementTypes>   InterleaveChildren;
};

/** The function for an element type.
 * \throw std::out_of_range */
template <typename TFunction>
const TFunction &
ForType(const std::array<TFunction, NumberOfElementTypes> & functions, const ElementType type)
{
  return functions.at(static_cast<std::size_t>(type));
}

/** What Target hides. */
struct TargetTable
{
  const char *            Name;
  TargetFunctions<float>  Float;
  TargetFunctions<double> Double;

  template <typename T>
  const TargetFunctions<T> &
  Get() const
  {
    if constexpr (sizeof(T) == sizeof(float))
    {
      return Float;
    }
    else
    {
      return Double;
    }
  }
};

/** The target that needs nothing but C++. */
const TargetTable &
GetPortableTarget();

/** The vectorised targets that this processor supports, the fastest first. Returns how many were written. */
int
GetVectorisedTargets(const TargetTable ** targets, int maximum);

} // namespace Subdivision
} // namespace itk

#endif
