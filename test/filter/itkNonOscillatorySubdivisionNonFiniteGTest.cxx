// SPDX-License-Identifier: Apache-2.0
// A voxel that is not finite spoils exactly the children whose 6-tap stencil reads it, in every scheme: those that see
// it through the thresholds stay finite, and those beyond the 10-tap stencil do not change at all.

#include "SubdivisionCommonFilters.h"

using namespace SubdivisionTest;

namespace
{

const std::vector<double> &
BadValues()
{
  constexpr double                 infinity = std::numeric_limits<double>::infinity();
  static const std::vector<double> values{ infinity, -infinity, std::numeric_limits<double>::quiet_NaN() };
  return values;
}

/** Whether the stencil of a child along one axis, from p - below to p + above, reads a voxel. */
bool
Reads(long child, long voxel, long size, long below, long above, BoundaryKind kind)
{
  const ref::Grid<1> positions = ref::MakeGrid<1>({ 0 }, { size }, [](const ref::Index<1> & i) { return i[0]; });
  const auto         boundary = ReferenceBoundary<1>(kind, -1.0);
  for (long i = ref::Child(child).p - below; i <= ref::Child(child).p + above; ++i)
  {
    if (boundary(positions, { i }) == voxel)
    {
      return true;
    }
  }
  return false;
}

/** Whether the stencil of a child reads a voxel along every axis. The output starts at 0. */
template <unsigned int D>
bool
ReadsAlongAll(const itk::Index<D> & child,
              const itk::Index<D> & voxel,
              const itk::Size<D> &  size,
              long                  below,
              long                  above,
              BoundaryKind          kind)
{
  for (unsigned int w = 0; w < D; ++w)
  {
    if (!Reads(child[w], voxel[w], static_cast<long>(size[w]), below, above, kind))
    {
      return false;
    }
  }
  return true;
}

template <typename TImage>
typename TImage::Pointer
Subdivided(const TImage * image, SchemeEnum scheme, BoundaryKind boundary)
{
  BoundaryConditions<TImage> boundaries;
  auto                       filter = itk::NonOscillatorySubdivisionImageFilter<TImage>::New();
  filter->SetScheme(scheme);
  filter->SetBoundaryCondition(boundaries.Get(boundary));
  return RunFilter(filter.GetPointer(), image);
}

/** Puts a bad value at a voxel and compares with the result without it. */
template <typename TImage>
void
ExpectOnlyReadersSpoilt(TImage *                           image,
                        const typename TImage::IndexType & voxel,
                        double                             badValue,
                        SchemeEnum                         scheme,
                        BoundaryKind                       boundary)
{
  SCOPED_TRACE(testing::Message() << badValue << " at " << voxel << ", " << scheme << ", " << NameOf(boundary));
  constexpr unsigned int D = TImage::ImageDimension;
  const auto             size = image->GetBufferedRegion().GetSize();
  const auto             good = image->GetPixel(voxel);
  const auto             clean = Subdivided<TImage>(image, scheme, boundary);
  image->SetPixel(voxel, static_cast<typename TImage::PixelType>(badValue));
  const auto spoilt = Subdivided<TImage>(image, scheme, boundary);
  image->SetPixel(voxel, good);

  itk::ImageRegionIteratorWithIndex<TImage> it(spoilt, spoilt->GetBufferedRegion());
  for (; !it.IsAtEnd(); ++it)
  {
    const auto child = it.GetIndex();
    const bool readByTaps = ReadsAlongAll<D>(child, voxel, size, 2, 3, boundary);
    const bool seesMore = scheme == SchemeEnum::NonOscillatory || scheme == SchemeEnum::Restored;
    const bool seesIt = seesMore ? ReadsAlongAll<D>(child, voxel, size, 4, 5, boundary) : readByTaps;
    if (scheme == SchemeEnum::Restored)
    {
      // The taps of P f: along one axis all that is seen, along several a part of it.
      ASSERT_FALSE((D == 1 ? seesIt : readByTaps) && std::isfinite(it.Get())) << child << " is " << it.Get();
    }
    else
    {
      ASSERT_EQ(std::isfinite(it.Get()), !readByTaps) << child << " is " << it.Get();
    }
    if (!seesIt)
    {
      ASSERT_EQ(it.Get(), clean->GetPixel(child)) << child;
    }
  }
}

template <typename TImage>
void
ExpectOnlyReadersSpoiltEverywhere(const ref::Index<TImage::ImageDimension> &      size,
                                  const std::vector<typename TImage::IndexType> & voxels,
                                  unsigned int                                    nature)
{
  const auto image = MakeImage<TImage>(MakeRegion<TImage>({}, size));
  FillWithTestData(image.GetPointer(), -1.0, 1.0, nature);
  for (const SchemeEnum scheme : AllSchemes())
  {
    for (const BoundaryKind boundary : AllBoundaries())
    {
      for (const double bad : BadValues())
      {
        for (const auto & voxel : voxels)
        {
          ASSERT_NO_FATAL_FAILURE(ExpectOnlyReadersSpoilt<TImage>(image.GetPointer(), voxel, bad, scheme, boundary));
        }
      }
    }
  }
}

} // namespace

TEST(NonOscillatorySubdivisionNonFinite, OneDimension)
{
  for (const unsigned int nature : { 0u, 2u })
  {
    ExpectOnlyReadersSpoiltEverywhere<Line>({ 24 }, { { { 0 } }, { { 3 } }, { { 12 } }, { { 22 } } }, nature);
  }
}

TEST(NonOscillatorySubdivisionNonFinite, ThreeDimensionsFloat)
{
  for (const unsigned int nature : { 0u, 2u })
  {
    ExpectOnlyReadersSpoiltEverywhere<FloatImage>({ 23, 12, 13 }, { { { 11, 6, 5 } }, { { 0, 11, 2 } } }, nature);
  }
}

TEST(NonOscillatorySubdivisionNonFinite, ThreeDimensionsDouble)
{
  ExpectOnlyReadersSpoiltEverywhere<DoubleImage>({ 12, 11, 21 }, { { { 6, 5, 10 } } }, 0);
}

/** Infinities of both signs in one stencil, and a whole image of them. */
TEST(NonOscillatorySubdivisionNonFinite, Several)
{
  const double infinity = std::numeric_limits<double>::infinity();
  for (const SchemeEnum scheme : AllSchemes())
  {
    std::vector<double> values(30, 1.0);
    values[10] = infinity;
    values[12] = -infinity;
    const auto some = Subdivided<Line>(LineOf<Line>(values), scheme, BoundaryKind::ZeroFlux);
    const auto all = Subdivided<Line>(LineOf<Line>(std::vector<double>(9, infinity)), scheme, BoundaryKind::ZeroFlux);
    for (long m = 0; m < 60; ++m)
    {
      // The taps of the restored scheme are those of P f, which reads two voxels further.
      const long more = scheme == SchemeEnum::Restored ? 2 : 0;
      const bool read = Reads(m, 10, 30, 2 + more, 3 + more, BoundaryKind::ZeroFlux) ||
                        Reads(m, 12, 30, 2 + more, 3 + more, BoundaryKind::ZeroFlux);
      EXPECT_EQ(std::isfinite(some->GetPixel({ { m } })), !read) << scheme << ", child " << m;
      EXPECT_FALSE(m < 18 && std::isfinite(all->GetPixel({ { m } }))) << scheme << ", child " << m;
    }
  }
}

/** Which region is asked for makes no difference where there are such voxels, either. */
TEST(NonOscillatorySubdivisionNonFinite, AnyRegion)
{
  const auto image = MakeImage<FloatImage>(MakeRegion<FloatImage>({}, { 26, 17, 19 }));
  FillWithTestData(image.GetPointer(), -1.0, 1.0, 2);
  std::mt19937 engine(5);
  for (int i = 0; i < 12; ++i)
  {
    FloatImage::IndexType voxel;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      voxel[axis] = static_cast<long>(engine() % image->GetBufferedRegion().GetSize(axis));
    }
    image->SetPixel(voxel, static_cast<float>(BadValues()[i % 3]));
  }
  const auto whole = Subdivided<FloatImage>(image, SchemeEnum::NonOscillatory, BoundaryKind::ZeroFlux);
  const auto isSame = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  for (int trial = 0; trial < 20; ++trial)
  {
    const auto filter = FloatFilter::New();
    filter->SetInput(image);
    filter->UpdateOutputInformation();
    filter->GetOutput()->SetRequestedRegion(RandomSubRegion(whole->GetLargestPossibleRegion(), engine));
    filter->Update();
    const FloatImage * const                           part = filter->GetOutput();
    itk::ImageRegionConstIteratorWithIndex<FloatImage> it(part, part->GetRequestedRegion());
    for (; !it.IsAtEnd(); ++it)
    {
      ASSERT_TRUE(isSame(it.Get(), whole->GetPixel(it.GetIndex()))) << it.GetIndex() << " of " << it.GetRegion();
    }
  }
}
