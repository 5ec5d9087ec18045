// SPDX-License-Identifier: Apache-2.0
#ifndef TestVolume_h
#define TestVolume_h

#include "itkImage.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace subdivision_benchmark
{

/** A number in [0, 1) that looks random and depends on `counter` alone (the splitmix64 generator). */
inline double
HashedUniform(std::uint64_t counter)
{
  std::uint64_t z = (counter + 1) * 0x9E3779B97F4A7C15ULL;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
}

/** A volume like a CT scan, in 0 ... 4000: a smooth shading, balls with sharp edges on a lattice, and noise. */
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
MakeTestVolume(unsigned int size)
{
  constexpr double pi = 3.14159265358979323846;
  constexpr long   latticePeriod = 24;
  constexpr long   squaredRadius = 81;

  std::vector<double> shading(size);
  std::vector<long>   squaredOffset(size);
  for (unsigned int i = 0; i < size; ++i)
  {
    shading[i] = std::cos(2.0 * pi * i / size);
    const long offset = static_cast<long>(i) % latticePeriod - latticePeriod / 2;
    squaredOffset[i] = offset * offset;
  }

  const auto image = itk::Image<TPixel, 3>::New();
  image->SetRegions(itk::Size<3>{ { size, size, size } });
  image->Allocate();
  TPixel *      pixel = image->GetBufferPointer();
  std::uint64_t counter = 0;
  for (unsigned int z = 0; z < size; ++z)
  {
    for (unsigned int y = 0; y < size; ++y)
    {
      for (unsigned int x = 0; x < size; ++x, ++counter)
      {
        const bool inBall = squaredOffset[x] + squaredOffset[y] + squaredOffset[z] <= squaredRadius;
        pixel[counter] = static_cast<TPixel>(1000.0 + 200.0 * (shading[x] + shading[y] + shading[z]) +
                                             (inBall ? 2000.0 : 0.0) + 300.0 * HashedUniform(counter));
      }
    }
  }
  return image;
}

/** The test volume of this size, made at the first call and kept, since interleaved rows come back to it. */
template <typename TPixel>
const itk::Image<TPixel, 3> *
GetTestVolume(unsigned int size)
{
  static std::map<unsigned int, typename itk::Image<TPixel, 3>::Pointer> volumes;

  auto & volume = volumes[size];
  if (volume.IsNull())
  {
    volume = MakeTestVolume<TPixel>(size);
  }
  return volume;
}

} // namespace subdivision_benchmark

#endif
