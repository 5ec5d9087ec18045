// SPDX-License-Identifier: Apache-2.0
// The filter as an itk::Object: defaults, printing, modification times, and that it leaves its input alone.

#include "SubdivisionCommonFilters.h"

using namespace SubdivisionTest;

namespace
{
template <typename TValue>
std::string
Printed(const TValue & value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}
} // namespace

TEST(NonOscillatorySubdivisionObject, Defaults)
{
  auto filter = DoubleFilter::New();
  EXPECT_EQ(filter->GetScheme(), SchemeEnum::NonOscillatory);
  EXPECT_EQ(filter->GetTension(), 2.0);
  EXPECT_EQ(filter->GetSubdividedAxes(), (itk::FixedArray<bool, 3>(true)));
  ASSERT_NE(filter->GetBoundaryCondition(), nullptr);
  EXPECT_NE(dynamic_cast<const itk::ZeroFluxNeumannBoundaryCondition<DoubleImage> *>(filter->GetBoundaryCondition()),
            nullptr);
  EXPECT_STREQ(filter->GetNameOfClass(), "NonOscillatorySubdivisionImageFilter");
}

TEST(NonOscillatorySubdivisionObject, SchemesHaveNames)
{
  EXPECT_NE(Printed(SchemeEnum::NonOscillatory).find("NonOscillatory"), std::string::npos);
  EXPECT_NE(Printed(SchemeEnum::Linear).find("Scheme::Linear"), std::string::npos);
  EXPECT_NE(Printed(SchemeEnum::BoundedLinear).find("Scheme::BoundedLinear"), std::string::npos);
  EXPECT_NE(Printed(SchemeEnum::BSpline).find("Scheme::BSpline"), std::string::npos);
  EXPECT_NE(Printed(static_cast<SchemeEnum>(99)).find("INVALID"), std::string::npos);
}

TEST(NonOscillatorySubdivisionObject, PrintsItsOptions)
{
  auto filter = DoubleFilter::New();
  filter->SetScheme(SchemeEnum::BSpline);
  filter->SetTension(3.25);
  SetAxes(filter.GetPointer(), { true, false, true });
  std::ostringstream text;
  filter->Print(text);
  for (const char * expected : { "BSpline", "Tension: 3.25", "SubdividedAxes: [1, 0, 1]", "BoundaryCondition" })
  {
    EXPECT_NE(text.str().find(expected), std::string::npos) << expected << " in " << text.str();
  }
}

TEST(NonOscillatorySubdivisionObject, OptionsModifyTheFilter)
{
  BoundaryConditions<DoubleImage>          boundaries;
  auto                                     filter = DoubleFilter::New();
  const std::vector<std::function<void()>> changes{ [&] { filter->SetScheme(SchemeEnum::Linear); },
                                                    [&] { filter->SetTension(4.0); },
                                                    [&] { filter->SetBoundaryCondition(&boundaries.mirror); },
                                                    [&] { SetAxes(filter.GetPointer(), { false, true, true }); } };
  for (std::size_t i = 0; i < changes.size(); ++i)
  {
    const auto before = filter->GetMTime();
    changes[i]();
    const auto after = filter->GetMTime();
    EXPECT_GT(after, before) << "change " << i;
    changes[i]();
    EXPECT_EQ(filter->GetMTime(), after) << "the same value again, change " << i;
  }
}

/** A filter that was changed computes anew, and one that was not keeps its output. */
TEST(NonOscillatorySubdivisionObject, UpdatesWhenNeeded)
{
  const auto input = MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ 0, 0, 0 }, { 5, 5, 5 }));
  FillWithTestData(input.GetPointer(), 0.0, 1.0, 0);
  auto filter = DoubleFilter::New();
  filter->SetInput(input);
  filter->Update();
  const double smooth = filter->GetOutput()->GetPixel({ { 4, 5, 6 } });
  const auto   time = filter->GetOutput()->GetUpdateMTime();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetUpdateMTime(), time);
  filter->SetScheme(SchemeEnum::Linear);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetUpdateMTime(), time);
  EXPECT_NE(filter->GetOutput()->GetPixel({ { 4, 5, 6 } }), smooth);
}

TEST(NonOscillatorySubdivisionObject, LeavesItsInputAlone)
{
  const auto region = MakeRegion<FloatImage>({ 1, -2, 3 }, { 40, 11, 9 });
  const auto input = MakeImage<FloatImage>(region);
  FillWithTestData(input.GetPointer(), -1.0, 1.0, 0);
  const std::vector<float> before(ScalarsOf(input.GetPointer()), ScalarsOf(input.GetPointer()) + 40 * 11 * 9);
  const auto               time = input->GetPixelContainer()->GetMTime();

  auto       filter = FloatFilter::New();
  const auto output = RunFilter(filter.GetPointer(), input.GetPointer());
  EXPECT_NE(output->GetPixelContainer(), input->GetPixelContainer());
  EXPECT_EQ(std::memcmp(before.data(), ScalarsOf(input.GetPointer()), before.size() * sizeof(float)), 0);
  EXPECT_EQ(input->GetBufferedRegion(), region);
  EXPECT_EQ(input->GetPixelContainer()->GetMTime(), time);
}

/** Options that do not concern a scheme do not change its result. */
TEST(NonOscillatorySubdivisionObject, OtherSchemesIgnoreTheTension)
{
  const auto input = MakeImage<FloatImage>(MakeRegion<FloatImage>({ 0, 0, 0 }, { 12, 7, 6 }));
  FillWithTestData(input.GetPointer(), -1.0, 1.0, 0);
  for (const SchemeEnum scheme : { SchemeEnum::Linear, SchemeEnum::BoundedLinear, SchemeEnum::BSpline })
  {
    auto filter = FloatFilter::New();
    filter->SetScheme(scheme);
    const auto once = RunFilter(filter.GetPointer(), input.GetPointer());
    filter->SetTension(7.0);
    EXPECT_TRUE(SameBytes(RunFilter(filter.GetPointer(), input.GetPointer()).GetPointer(), once.GetPointer()))
      << scheme;
  }
}
