// SPDX-License-Identifier: Apache-2.0
// The mirror boundary condition, which ITK lacks, by index, through a neighbourhood, and in the region it asks for.

#include "SubdivisionTestHelpers.h"

#include "itkConstNeighborhoodIterator.h"

using namespace SubdivisionTest;

namespace
{

using Image = itk::Image<short, 2>;
using Mirror = itk::MirrorBoundaryCondition<Image>;

Image::Pointer
SomeImage(const ref::Index<2> & start, const ref::Index<2> & size)
{
  return ImageOf<Image>(MakeRegion<Image>(start, size), [](const itk::Index<2> & i) { return 100 * i[1] + 7 * i[0]; });
}

} // namespace

TEST(MirrorBoundaryCondition, AnyIndexAnyDistanceOutside)
{
  const Mirror mirror;
  for (const ref::Index<2> & size : { ref::Index<2>{ 4, 3 }, ref::Index<2>{ 1, 2 } })
  {
    const ref::Index<2> start{ -3, 5 };
    const auto          image = SomeImage(start, size);
    const auto          expected = ref::Mirror<2>();
    const auto          grid = ToGrid(image.GetPointer());
    ref::ForEachIndex<2>({ -20, -20 }, { 40, 40 }, [&](const ref::Index<2> & i) {
      EXPECT_EQ(mirror.GetPixel({ { start[0] + i[0], start[1] + i[1] } }, image), expected(grid, i));
    });
  }
}

TEST(MirrorBoundaryCondition, WorksInNeighborhoodIterators)
{
  const auto                                    image = SomeImage({ 2, -4 }, { 6, 5 });
  Mirror                                        mirror;
  itk::ConstNeighborhoodIterator<Image, Mirror> it({ { 3, 2 } }, image, image->GetBufferedRegion());
  for (; !it.IsAtEnd(); ++it)
  {
    for (itk::SizeValueType n = 0; n < it.Size(); ++n)
    {
      EXPECT_EQ(it.GetPixel(n), mirror.GetPixel(it.GetIndex(n), image)) << it.GetIndex(n);
    }
  }
}

TEST(MirrorBoundaryCondition, WorksOnVectorImages)
{
  using Vectors = itk::VectorImage<short, 2>;
  const auto image = MakeImage<Vectors>(MakeRegion<Vectors>({ 0, 0 }, { 3, 3 }), 2);
  FillWithTestData(image.GetPointer(), -100.0, 100.0, 0);
  const itk::MirrorBoundaryCondition<Vectors> mirror;
  EXPECT_EQ(mirror.GetPixel({ { -2, 4 } }, image), image->GetPixel({ { 1, 1 } }));
}

/** Every pixel that a region depends on, and no more than a box around them. */
TEST(MirrorBoundaryCondition, RequestsWhatItReads)
{
  const Mirror        mirror;
  const ref::Index<2> start{ 3, -2 };
  for (const long size : { 1L, 2L, 7L })
  {
    const auto largest = MakeRegion<Image>(start, { size, size });
    for (long first = -9; first < 12; ++first)
    {
      for (long count = 1; count < 9; ++count)
      {
        const auto asked = MakeRegion<Image>({ start[0] + first, start[1] }, { count, 1 });
        long       lowest = size;
        long       highest = -1;
        const auto positions = ref::MakeGrid<1>({ 0 }, { size }, [](const ref::Index<1> & i) { return i[0]; });
        for (long i = first; i < first + count; ++i)
        {
          const long read = static_cast<long>(ref::Mirror<1>()(positions, { i }));
          lowest = std::min(lowest, read);
          highest = std::max(highest, read);
        }
        EXPECT_EQ(mirror.GetInputRequestedRegion(largest, asked),
                  MakeRegion<Image>({ start[0] + lowest, start[1] }, { highest - lowest + 1, 1 }))
          << "from " << first << ", " << count << " of " << size;
      }
    }
  }
}
