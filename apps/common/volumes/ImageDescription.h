// SPDX-License-Identifier: Apache-2.0
#ifndef ImageDescription_h
#define ImageDescription_h

#include "NonOscillatorySubdivision/ArrayView.h"
#include "NonOscillatorySubdivision/ElementType.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

/** Where the voxels of an image lie: an entry for each axis, the fastest one first. */
struct ImageGrid
{
  std::vector<std::uint64_t>       Size;
  std::vector<double>              Spacing;    // mm where the file says so, else its unit
  std::vector<double>              Origin;     // of the centre of the first voxel; LPS where the file says a space
  std::vector<std::vector<double>> Directions; // of each axis, a unit vector
};

/** What the components of a voxel mean. */
enum class VoxelKind
{
  Scalar,
  Rgb,
  Rgba,
  Complex,
  Vector,
  SymmetricTensor
};

/** All that is known of an image but its voxels. */
struct ImageDescription
{
  ImageGrid                          Grid;
  itk::Subdivision::ElementType      Component{};
  unsigned int                       NumberOfComponents = 1; // of a voxel, side by side
  VoxelKind                          Kind = VoxelKind::Scalar;
  std::string                        Format;   // for people: "NRRD", "TIFF folder", ...
  std::map<std::string, std::string> Metadata; // what else the file says, key by key, in its format's names

  std::uint64_t
  GetNumberOfVoxels() const
  {
    std::uint64_t number = 1;
    for (const std::uint64_t size : Grid.Size)
    {
      number *= size;
    }
    return number;
  }

  std::uint64_t
  GetVoxelBytes() const
  {
    return NumberOfComponents * itk::Subdivision::SizeOf(Component);
  }

  /** Those of all voxels. */
  std::uint64_t
  GetBytes() const
  {
    return this->GetNumberOfVoxels() * this->GetVoxelBytes();
  }
};

/** Takes a warning, one sentence, to where the user sees it. */
using WarningSink = std::function<void(const std::string &)>;

#endif
