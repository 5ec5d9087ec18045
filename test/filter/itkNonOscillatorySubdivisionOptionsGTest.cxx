// SPDX-License-Identifier: Apache-2.0
// Options by name and by number: what is none of them is refused when it is set, and the message says what is allowed.

#include "SubdivisionCommonFilters.h"

using namespace SubdivisionTest;

namespace
{

const std::vector<std::pair<const char *, SchemeEnum>> Names{ { "nonoscillatory", SchemeEnum::NonOscillatory },
                                                              { "linear", SchemeEnum::Linear },
                                                              { "bounded", SchemeEnum::BoundedLinear },
                                                              { "bspline", SchemeEnum::BSpline },
                                                              { "restored", SchemeEnum::Restored } };

template <typename TFunction>
std::string
ErrorOf(const TFunction & function)
{
  try
  {
    function();
  }
  catch (const itk::ExceptionObject & error)
  {
    return error.GetDescription();
  }
  return {};
}

} // namespace

TEST(NonOscillatorySubdivisionOptions, SchemesByName)
{
  auto filter = LineFilter::New();
  for (const auto & [name, scheme] : Names)
  {
    filter->SetSchemeByName(name);
    EXPECT_EQ(filter->GetScheme(), scheme);
  }
  for (const char * wrong : { "", "Linear", "cubic", "linear " })
  {
    const std::string error = ErrorOf([&] { filter->SetSchemeByName(wrong); });
    for (const auto & named : Names)
    {
      EXPECT_NE(error.find(named.first), std::string::npos) << error;
    }
    EXPECT_EQ(filter->GetScheme(), SchemeEnum::Restored);
  }
}

TEST(NonOscillatorySubdivisionOptions, SchemesBeyondTheLastAreRefused)
{
  auto filter = LineFilter::New();
  filter->SetScheme(SchemeEnum::Linear);
  for (const int number : { 5, 99, 255 })
  {
    const std::string error = ErrorOf([&] { filter->SetScheme(static_cast<SchemeEnum>(number)); });
    EXPECT_NE(error.find(std::to_string(number)), std::string::npos) << error;
    EXPECT_EQ(filter->GetScheme(), SchemeEnum::Linear);
  }
}

/** The restored scheme alone takes tensions from 0 on. */
TEST(NonOscillatorySubdivisionOptions, TensionsByScheme)
{
  auto filter = LineFilter::New();
  filter->SetInput(LineOf<Line>({ 1, 2, 4, 3 }));
  const auto errorWith = [&](const char * scheme, const double tension) {
    filter->SetSchemeByName(scheme);
    filter->SetTension(tension);
    return ErrorOf([&] { filter->Update(); });
  };
  for (const double tension : { 0.0, 0.5, 1.0, 2.0 })
  {
    EXPECT_EQ(errorWith("restored", tension), "") << tension;
  }
  for (const double tension : { -0.001, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    EXPECT_NE(errorWith("restored", tension).find("restored"), std::string::npos) << tension;
  }
  for (const char * scheme : { "nonoscillatory", "linear", "bounded", "bspline" })
  {
    EXPECT_NE(errorWith(scheme, 1.0).find(scheme), std::string::npos) << scheme;
    EXPECT_EQ(errorWith(scheme, 1.001), "") << scheme;
  }
}

TEST(NonOscillatorySubdivisionOptions, OneAxis)
{
  auto filter = DoubleFilter::New();
  filter->SetSubdividedAxis(1, false);
  EXPECT_TRUE(filter->GetSubdividedAxes()[0]);
  EXPECT_FALSE(filter->GetSubdividedAxes()[1]);
  EXPECT_TRUE(filter->GetSubdividedAxes()[2]);
  const auto time = filter->GetMTime();
  filter->SetSubdividedAxis(1, false);
  EXPECT_EQ(filter->GetMTime(), time);
  filter->SetSubdividedAxis(1, true);
  EXPECT_GT(filter->GetMTime(), time);
  EXPECT_EQ(filter->GetSubdividedAxes(), (itk::FixedArray<bool, 3>(true)));
  const std::string error = ErrorOf([&] { filter->SetSubdividedAxis(3, true); });
  EXPECT_NE(error.find("3"), std::string::npos) << error;
}

TEST(NonOscillatorySubdivisionOptions, ThePrintedTarget)
{
  auto filter = DoubleFilter::New();
  filter->SetTarget("portable");
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("Target: portable"), std::string::npos) << text.str();
}
