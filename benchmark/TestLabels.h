// SPDX-License-Identifier: Apache-2.0
#ifndef TestLabels_h
#define TestLabels_h

#include "TestVolume.h"

#include <array>

namespace subdivision_benchmark
{

/** A label map like the segmentation of a body: 20 balls, the organs 1 ... 20, in a background of 0. */
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer
MakeTestLabels(unsigned int size)
{
  struct Organ
  {
    std::array<double, 3> Centre;
    double                Radius;
  };
  std::array<Organ, 20> organs;
  std::uint64_t         counter = 0;
  for (Organ & organ : organs)
  {
    for (double & position : organ.Centre)
    {
      position = size * (0.1 + 0.8 * HashedUniform(counter++));
    }
    organ.Radius = size * (0.04 + 0.1 * HashedUniform(counter++));
  }

  const auto image = itk::Image<TPixel, 3>::New();
  image->SetRegions(itk::Size<3>{ { size, size, size } });
  image->Allocate();
  image->FillBuffer(0);
  TPixel label = 0;
  for (const Organ & organ : organs)
  {
    ++label;
    TPixel * pixel = image->GetBufferPointer();
    for (unsigned int z = 0; z < size; ++z)
    {
      for (unsigned int y = 0; y < size; ++y)
      {
        for (unsigned int x = 0; x < size; ++x, ++pixel)
        {
          const double square =
            std::pow(x - organ.Centre[0], 2) + std::pow(y - organ.Centre[1], 2) + std::pow(z - organ.Centre[2], 2);
          *pixel = square < organ.Radius * organ.Radius ? label : *pixel;
        }
      }
    }
  }
  return image;
}

/** The label map of this size, made at the first call and kept, as the test volume is. */
template <typename TPixel>
const itk::Image<TPixel, 3> *
GetTestLabels(unsigned int size)
{
  static std::map<unsigned int, typename itk::Image<TPixel, 3>::Pointer> maps;

  auto & map = maps[size];
  if (map.IsNull())
  {
    map = MakeTestLabels<TPixel>(size);
  }
  return map;
}

} // namespace subdivision_benchmark

#endif
