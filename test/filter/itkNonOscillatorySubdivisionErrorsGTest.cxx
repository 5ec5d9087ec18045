// SPDX-License-Identifier: Apache-2.0
// Every error is an itk::ExceptionObject that names the value and what is allowed, and the filter can be used
// afterwards.

#include "SubdivisionCommonFilters.h"

#include <algorithm>
#include <cctype>

using namespace SubdivisionTest;

namespace
{

/** What the exception of an update says, in lower case; empty if there is none. */
template <typename TFilter>
std::string
ErrorOf(TFilter * filter)
{
  try
  {
    filter->UpdateLargestPossibleRegion();
  }
  catch (const itk::ExceptionObject & error)
  {
    std::string text = error.GetDescription();
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
  }
  return {};
}

testing::AssertionResult
Names(const std::string & error, const std::vector<std::string> & parts)
{
  for (const std::string & part : parts)
  {
    if (error.find(part) == std::string::npos)
    {
      return testing::AssertionFailure() << "no \"" << part << "\" in \"" << error << '"';
    }
  }
  return testing::AssertionSuccess();
}

Line::Pointer
SomeLine()
{
  return LineOf<Line>({ 1, 2, 4, 3 });
}

} // namespace

TEST(NonOscillatorySubdivisionErrors, Tension)
{
  const double                                      infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<double, std::string>> bad{
    { std::nan(""), "nan" }, { infinity, "inf" }, { -infinity, "-inf" }, { 1.0, "1" },
    { 0.75, "0.75" },        { -2.5, "-2.5" },    { 0.0, "0" }
  };
  auto filter = LineFilter::New();
  filter->SetInput(SomeLine());
  for (const auto & [tension, name] : bad)
  {
    filter->SetTension(tension);
    EXPECT_TRUE(Names(ErrorOf(filter.GetPointer()), { "tension", name, "finite", "1" }));
  }
  filter->SetTension(2.0);
  EXPECT_EQ(ErrorOf(filter.GetPointer()), "");
  EXPECT_EQ(CountScalars(filter->GetOutput()), 8u);
}

TEST(NonOscillatorySubdivisionErrors, MissingInput)
{
  auto filter = LineFilter::New();
  EXPECT_TRUE(Names(ErrorOf(filter.GetPointer()), { "input", "required" }));
  filter->SetInput(SomeLine());
  EXPECT_EQ(ErrorOf(filter.GetPointer()), "");
}

TEST(NonOscillatorySubdivisionErrors, ZeroSizedInput)
{
  auto filter = DoubleFilter::New();
  filter->SetInput(MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ 0, 0, 0 }, { 4, 0, 3 })));
  EXPECT_TRUE(Names(ErrorOf(filter.GetPointer()), { "size", "[4, 0, 3]", "at least one" }));

  const auto good = MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ 0, 0, 0 }, { 4, 1, 3 }));
  good->FillBuffer(1.5);
  filter->SetInput(good);
  EXPECT_EQ(ErrorOf(filter.GetPointer()), "");
  EXPECT_EQ(filter->GetOutput()->GetPixel({ { 7, 1, 5 } }), 1.5);
}

/** An empty axis is an error also where it is not the one that is subdivided. */
TEST(NonOscillatorySubdivisionErrors, ZeroSizedKeptAxis)
{
  auto filter = DoubleFilter::New();
  SetAxes(filter.GetPointer(), { true, true, false });
  filter->SetInput(MakeImage<DoubleImage>(MakeRegion<DoubleImage>({ 0, 0, 0 }, { 4, 2, 0 })));
  EXPECT_TRUE(Names(ErrorOf(filter.GetPointer()), { "[4, 2, 0]" }));
}

TEST(NonOscillatorySubdivisionErrors, MoreThanThreeAxes)
{
  using Series = itk::Image<float, 4>;
  auto       filter = itk::NonOscillatorySubdivisionImageFilter<Series>::New();
  const auto input = MakeImage<Series>(MakeRegion<Series>({ 0, 0, 0, 0 }, { 2, 2, 2, 2 }));
  input->FillBuffer(3.0f);
  filter->SetInput(input);
  SetAxes(filter.GetPointer(), { true, true, true, true });
  EXPECT_TRUE(Names(ErrorOf(filter.GetPointer()), { "4 axes", "at most 3" }));

  SetAxes(filter.GetPointer(), { true, false, true, true });
  EXPECT_EQ(ErrorOf(filter.GetPointer()), "");
  EXPECT_EQ(filter->GetOutput()->GetLargestPossibleRegion(), MakeRegion<Series>({ 0, 0, 0, 0 }, { 4, 2, 4, 4 }));
}

TEST(NonOscillatorySubdivisionErrors, RegionsOutsideTheOutput)
{
  auto filter = LineFilter::New();
  filter->SetInput(SomeLine());
  filter->UpdateOutputInformation();
  for (const itk::IndexValueType first : { -1, 7, 8, 100 })
  {
    filter->GetOutput()->SetRequestedRegion(MakeRegion<Line>({ first }, { 2 }));
    EXPECT_THROW(filter->GetOutput()->Update(), itk::InvalidRequestedRegionError) << first;
  }
  filter->GetOutput()->SetRequestedRegion(MakeRegion<Line>({ 6 }, { 2 }));
  EXPECT_NO_THROW(filter->GetOutput()->Update());
}

TEST(NonOscillatorySubdivisionErrors, InputWithoutMemory)
{
  auto filter = LineFilter::New();
  auto input = Line::New();
  input->SetRegions(MakeRegion<Line>({ 0 }, { 4 }));
  filter->SetInput(input);
  EXPECT_TRUE(Names(ErrorOf(filter.GetPointer()), { "the input has no data" }));
}
