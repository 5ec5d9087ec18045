// SPDX-License-Identifier: Apache-2.0
// One filter used again and again with other inputs and options, two filters in two threads, grafted outputs, and sizes
// at the seams between tiles.

#include "SubdivisionCommonFilters.h"

#include <thread>

using namespace SubdivisionTest;

namespace
{

struct Setting
{
  ref::Index<3> size;
  SchemeEnum    scheme;
  BoundaryKind  boundary;
  ref::Axes<3>  axes;
  double        tension;
  const char *  target;
  unsigned int  workUnits;
};

std::vector<Setting>
Settings()
{
  const std::vector<ref::Index<3>> sizes{ { 5, 6, 7 }, { 300, 4, 3 }, { 1, 1, 1 }, { 40, 50, 30 }, { 2, 90, 3 } };
  const auto                       subsets = ref::SubsetsOf<3>({ true, true, true });
  std::vector<SchemeEnum>          schemes = AllSchemes();
  schemes.push_back(SchemeEnum::Restored);
  std::vector<Setting> settings;
  for (std::size_t i = 0; i < 40; ++i)
  {
    settings.push_back({ sizes[i % 5],
                         schemes[i / 2 % schemes.size()],
                         AllBoundaries()[i % 4],
                         subsets[i % subsets.size()],
                         1.5 + static_cast<double>(i % 3),
                         i % 7 == 0 ? "portable" : "",
                         1 + static_cast<unsigned int>(i % 4) });
  }
  return settings;
}

FloatImage::Pointer
Subdivide(FloatFilter * const filter, BoundaryConditions<FloatImage> & boundaries, const Setting & setting)
{
  const auto input = MakeImage<FloatImage>(MakeRegion<FloatImage>({ 2, -3, 0 }, setting.size));
  FillWithTestData(input.GetPointer(), -1.0, 1.0, 2);
  filter->SetScheme(setting.scheme);
  filter->SetBoundaryCondition(boundaries.Get(setting.boundary));
  filter->SetTension(setting.tension);
  filter->SetTarget(setting.target);
  filter->SetNumberOfWorkUnits(setting.workUnits);
  SetAxes(filter, setting.axes);
  return RunFilter(filter, input.GetPointer());
}

std::vector<FloatImage::Pointer>
SubdivideByNewFilters()
{
  BoundaryConditions<FloatImage>   boundaries;
  std::vector<FloatImage::Pointer> outputs;
  for (const Setting & setting : Settings())
  {
    outputs.push_back(Subdivide(FloatFilter::New().GetPointer(), boundaries, setting));
  }
  return outputs;
}

/** Each of two halves along an axis alone has the bytes of the whole. */
void
ExpectSeamless(const ref::Index<3> & size)
{
  const auto input = MakeImage<FloatImage>(MakeRegion<FloatImage>({ 0, 0, 0 }, size));
  FillWithTestData(input.GetPointer(), -1.0, 1.0, 0);
  auto       filter = FloatFilter::New();
  const auto whole = RunFilter(filter.GetPointer(), input.GetPointer());
  filter->SetNumberOfWorkUnits(1);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const long cut = size[axis] | 1;
    for (const bool isUpper : { false, true })
    {
      auto region = whole->GetLargestPossibleRegion();
      region.SetIndex(axis, isUpper ? cut : 0);
      region.SetSize(axis, static_cast<itk::SizeValueType>(isUpper ? 2 * size[axis] - cut : cut));
      if (region.GetSize(axis) > 0)
      {
        filter->SetInput(input);
        filter->GetOutput()->SetRequestedRegion(region);
        filter->Update();
        EXPECT_TRUE(SameBytesAsPartOf(filter->GetOutput(), whole.GetPointer())) << axis << ", " << region;
      }
    }
  }
}

} // namespace

TEST(NonOscillatorySubdivisionReuse, OneFilterDoesAsNewOnes)
{
  const auto                     expected = SubdivideByNewFilters();
  const auto                     settings = Settings();
  BoundaryConditions<FloatImage> boundaries;
  auto                           filter = FloatFilter::New();
  for (std::size_t i = 0; i < settings.size(); ++i)
  {
    const auto output = Subdivide(filter.GetPointer(), boundaries, settings[i]);
    EXPECT_TRUE(SameBytes(output.GetPointer(), expected[i].GetPointer())) << "setting " << i;
  }
}

TEST(NonOscillatorySubdivisionReuse, TwoFiltersInTwoThreads)
{
  const auto                                      expected = SubdivideByNewFilters();
  std::array<std::vector<FloatImage::Pointer>, 2> outputs;
  std::thread                                     other([&] { outputs[1] = SubdivideByNewFilters(); });
  outputs[0] = SubdivideByNewFilters();
  other.join();
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_TRUE(SameBytes(outputs[0][i].GetPointer(), expected[i].GetPointer())) << "setting " << i;
    EXPECT_TRUE(SameBytes(outputs[1][i].GetPointer(), expected[i].GetPointer())) << "setting " << i;
  }
}

/** In a pipeline within a filter, the output is that of the filter around it. */
TEST(NonOscillatorySubdivisionReuse, WritesIntoAGraftedOutput)
{
  const auto input = MakeImage<FloatImage>(MakeRegion<FloatImage>({ 3, 0, -5 }, { 30, 20, 10 }));
  FillWithTestData(input.GetPointer(), -1.0, 1.0, 0);
  auto       filter = FloatFilter::New();
  const auto expected = RunFilter(filter.GetPointer(), input.GetPointer());

  const auto grafted = MakeImage<FloatImage>(expected->GetLargestPossibleRegion());
  grafted->FillBuffer(-77.0f);
  auto inner = FloatFilter::New();
  inner->SetInput(input);
  inner->GraftOutput(grafted);
  inner->Update();
  EXPECT_EQ(inner->GetOutput()->GetBufferPointer(), grafted->GetBufferPointer());
  EXPECT_TRUE(SameBytes(grafted.GetPointer(), expected.GetPointer()));
}

TEST(NonOscillatorySubdivisionReuse, SeamsBetweenTiles)
{
  for (const long width : { 255, 256, 257, 1023, 1024, 1025 })
  {
    SCOPED_TRACE(width);
    ExpectSeamless({ width, 3, 2 });
    ExpectSeamless({ 2, width, 3 });
    ExpectSeamless({ 3, 2, width });
  }
}

/** An output of more than 16 MiB, which is written past the cache. */
TEST(NonOscillatorySubdivisionReuse, LargeOutputs) { ExpectSeamless({ 101, 87, 79 }); }
