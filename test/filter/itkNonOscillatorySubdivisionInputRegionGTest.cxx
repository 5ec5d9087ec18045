// SPDX-License-Identifier: Apache-2.0
// The filter asks upstream for exactly the voxels that its stencil reads.

#include "SubdivisionCommonFilters.h"
#include "SubdivisionRegionSource.h"

using namespace SubdivisionTest;

namespace
{

/** The first and the last voxel, counted from the image's start and not cropped, that the children `first` to `last`
 * of one axis read. */
std::pair<long, long>
StencilOf(long first, long last, SchemeEnum scheme)
{
  const bool isFar = scheme == SchemeEnum::NonOscillatory || scheme == SchemeEnum::Restored;
  const long below = isFar ? 4 : 2;
  const long above = isFar ? 5 : 3;
  return { ref::Child(first).p - below, ref::Child(last).p + above };
}

/** What of a stencil lies in an image of `size` voxels. */
std::pair<long, long>
WithinImage(std::pair<long, long> stencil, long size, BoundaryKind boundary)
{
  const bool wraps = stencil.first < 0 || stencil.second >= size;
  if (boundary == BoundaryKind::Periodic && wraps)
  {
    return { 0, size - 1 };
  }
  return { std::max(stencil.first, 0L), std::min(stencil.second, size - 1) };
}

DoubleImage::RegionType
RequestedInput(const ref::Index<3> &           start,
               const ref::Index<3> &           size,
               const DoubleImage::RegionType & output,
               SchemeEnum                      scheme,
               BoundaryKind                    boundary,
               const ref::Axes<3> &            axes)
{
  BoundaryConditions<DoubleImage> boundaries;
  auto                            source = RegionSource<DoubleImage>::New();
  source->SetLargestRegion(MakeRegion<DoubleImage>(start, size));
  auto filter = DoubleFilter::New();
  filter->SetInput(source->GetOutput());
  filter->SetScheme(scheme);
  filter->SetBoundaryCondition(boundaries.Get(boundary));
  SetAxes(filter.GetPointer(), axes);
  filter->UpdateOutputInformation();
  filter->GetOutput()->SetRequestedRegion(output);
  filter->GetOutput()->PropagateRequestedRegion();
  return source->GetOutput()->GetRequestedRegion();
}

/** Tries children `first` to `last` of the x axis; y asks for a child in the middle, z is kept. */
void
ExpectRequest(long first, long last, SchemeEnum scheme, BoundaryKind boundary)
{
  SCOPED_TRACE(testing::Message() << scheme << ", " << NameOf(boundary) << ", children " << first << " to " << last);
  const ref::Index<3> start{ -11, 6, 3 };
  const ref::Index<3> size{ 24, 40, 7 };
  const auto          output =
    MakeRegion<DoubleImage>({ 2 * start[0] + first, 2 * start[1] + 40, 4 }, { last - first + 1, 1, 2 });

  const auto x = WithinImage(StencilOf(first, last, scheme), size[0], boundary);
  const auto y = WithinImage(StencilOf(40, 40, scheme), size[1], boundary);
  const auto expected = MakeRegion<DoubleImage>({ start[0] + x.first, start[1] + y.first, 4 },
                                                { x.second - x.first + 1, y.second - y.first + 1, 2 });
  EXPECT_EQ(RequestedInput(start, size, output, scheme, boundary, { true, true, false }), expected);
}

} // namespace

TEST(NonOscillatorySubdivisionInputRegion, IsTheExactStencil)
{
  for (const SchemeEnum scheme : AllSchemes())
  {
    for (const BoundaryKind boundary : AllBoundaries())
    {
      // In the middle, at even and odd children.
      ExpectRequest(20, 20, scheme, boundary);
      ExpectRequest(21, 21, scheme, boundary);
      ExpectRequest(20, 25, scheme, boundary);
      ExpectRequest(21, 24, scheme, boundary);
      // Over the low side, the high side, and both.
      ExpectRequest(0, 0, scheme, boundary);
      ExpectRequest(1, 5, scheme, boundary);
      ExpectRequest(47, 47, scheme, boundary);
      ExpectRequest(40, 46, scheme, boundary);
      ExpectRequest(0, 47, scheme, boundary);
    }
  }
}

TEST(NonOscillatorySubdivisionInputRegion, LargestAsksForAll)
{
  for (const BoundaryKind boundary : AllBoundaries())
  {
    const ref::Index<3> start{ 5, -3, 0 };
    const ref::Index<3> size{ 4, 1, 9 };
    const auto          output = MakeRegion<DoubleImage>({ 10, -6, 0 }, { 8, 2, 18 });
    EXPECT_EQ(RequestedInput(start, size, output, SchemeEnum::Linear, boundary, { true, true, true }),
              MakeRegion<DoubleImage>(start, size))
      << NameOf(boundary);
  }
}
