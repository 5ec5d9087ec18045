// SPDX-License-Identifier: Apache-2.0
// Exchanging or reversing axes before the subdivision or after it is the same.

#include "SubdivisionCommonFilters.h"

#include "itkFlipImageFilter.h"
#include "itkPermuteAxesImageFilter.h"

using namespace SubdivisionTest;

namespace
{

DoubleImage::Pointer
Subdivided(const DoubleImage * image, SchemeEnum scheme, BoundaryKind boundary)
{
  BoundaryConditions<DoubleImage> boundaries;
  auto                            filter = DoubleFilter::New();
  filter->SetScheme(scheme);
  filter->SetTension(1.5);
  filter->SetBoundaryCondition(boundaries.Get(boundary));
  return RunFilter(filter.GetPointer(), image);
}

DoubleImage::Pointer
Permuted(const DoubleImage * image, const std::array<unsigned int, 3> & order)
{
  auto permute = itk::PermuteAxesImageFilter<DoubleImage>::New();
  permute->SetOrder(itk::FixedArray<unsigned int, 3>(order.data()));
  return RunFilter(permute.GetPointer(), image);
}

DoubleImage::Pointer
Flipped(const DoubleImage * image, bool x, bool y, bool z)
{
  auto                     flip = itk::FlipImageFilter<DoubleImage>::New();
  itk::FixedArray<bool, 3> axes;
  axes[0] = x;
  axes[1] = y;
  axes[2] = z;
  flip->SetFlipAxes(axes);
  return RunFilter(flip.GetPointer(), image);
}

/** Noise, blocks and spikes within [-1, 1]. */
std::vector<DoubleImage::Pointer>
TestImages()
{
  std::vector<DoubleImage::Pointer> images;
  for (const unsigned int nature : { 0u, 2u, 3u })
  {
    images.push_back(MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ 0, 0, 0 }, { 13, 8, 10 })));
    FillWithTestData(images.back().GetPointer(), -1.0, 1.0, nature);
  }
  return images;
}

// The terms are summed in another order: a few units in the last place.
constexpr double Tolerance = 1e-14;

} // namespace

TEST(NonOscillatorySubdivisionSymmetry, UnderPermutationsOfAxes)
{
  const std::array<std::array<unsigned int, 3>, 5> orders{
    { { 1, 0, 2 }, { 0, 2, 1 }, { 2, 1, 0 }, { 1, 2, 0 }, { 2, 0, 1 } }
  };
  for (const auto & image : TestImages())
  {
    for (const SchemeEnum scheme : AllSchemes())
    {
      const auto subdivided = Subdivided(image, scheme, BoundaryKind::ZeroFlux);
      for (const auto & order : orders)
      {
        const auto first = Subdivided(Permuted(image, order), scheme, BoundaryKind::ZeroFlux);
        const auto last = Permuted(subdivided, order);
        EXPECT_LE(LargestDifference(first.GetPointer(), last.GetPointer()), Tolerance)
          << scheme << ", order " << order[0] << order[1] << order[2];
      }
    }
  }
}

TEST(NonOscillatorySubdivisionSymmetry, UnderReflections)
{
  for (const auto & image : TestImages())
  {
    for (const SchemeEnum scheme : AllSchemes())
    {
      for (const BoundaryKind boundary : AllBoundaries())
      {
        const auto subdivided = Subdivided(image, scheme, boundary);
        for (unsigned int axes = 1; axes < 8; ++axes)
        {
          const bool x = (axes & 1) != 0;
          const bool y = (axes & 2) != 0;
          const bool z = (axes & 4) != 0;
          const auto first = Subdivided(Flipped(image, x, y, z), scheme, boundary);
          const auto last = Flipped(subdivided, x, y, z);
          EXPECT_LE(LargestDifference(first.GetPointer(), last.GetPointer()), Tolerance)
            << scheme << ", " << NameOf(boundary) << ", flipped " << x << y << z;
        }
      }
    }
  }
}

/** A mirror boundary is what subdividing the doubled, mirrored periodic image gives. */
TEST(NonOscillatorySubdivisionSymmetry, MirrorIsPeriodicOfTheMirroredImage)
{
  const auto image = TestImages().front();
  const auto size = image->GetBufferedRegion().GetSize();
  const auto doubled = ImageOf<DoubleImage>(
    MakeRegion<DoubleImage>(
      { 0, 0, 0 }, { 2 * static_cast<long>(size[0]), 2 * static_cast<long>(size[1]), 2 * static_cast<long>(size[2]) }),
    [&](itk::Index<3> i) {
      for (unsigned int w = 0; w < 3; ++w)
      {
        const long n = static_cast<long>(size[w]);
        i[w] = i[w] < n ? i[w] : 2 * n - 1 - i[w];
      }
      return image->GetPixel(i);
    });
  const auto mirror = Subdivided(image, SchemeEnum::NonOscillatory, BoundaryKind::Mirror);
  const auto periodic = Subdivided(doubled, SchemeEnum::NonOscillatory, BoundaryKind::Periodic);
  EXPECT_TRUE(SameBytesAsPartOf(mirror.GetPointer(), periodic.GetPointer()));
}
