// SPDX-License-Identifier: Apache-2.0
// Every instruction set that this processor has computes what the portable kernel does, on every narrow width, and the
// same bytes whatever region is asked for.

#include "SubdivisionCommonFilters.h"

#include "NonOscillatorySubdivision/Target.h"

#include <atomic>
#include <thread>

using namespace SubdivisionTest;

namespace
{

using ByteImage = itk::Image<unsigned char, 3>;
using SignedByteImage = itk::Image<signed char, 3>;
using ShortImage = itk::Image<short, 3>;

/** The targets besides the portable one. */
std::vector<std::string>
VectorTargets()
{
  auto targets = itk::Subdivision::Target::GetNames();
  targets.pop_back();
  return targets;
}

struct Setting
{
  SchemeEnum   scheme;
  BoundaryKind boundary;
  ref::Axes<3> axes;
};

std::ostream &
operator<<(std::ostream & out, const Setting & s)
{
  return out << s.scheme << ", " << NameOf(s.boundary) << ", axes " << s.axes[0] << s.axes[1] << s.axes[2];
}

/** Every scheme, with boundaries and subsets of axes that change from one width to the next. */
std::vector<Setting>
SettingsFor(long width)
{
  const auto           subsets = ref::SubsetsOf<3>({ true, true, true });
  std::vector<Setting> settings;
  for (const SchemeEnum scheme : AllSchemes())
  {
    const long turn = width + 3 * static_cast<long>(scheme);
    settings.push_back({ scheme, AllBoundaries()[turn % 4], subsets[1 + turn % 7] });
    settings.push_back({ scheme, BoundaryKind::ZeroFlux, { true, true, true } });
  }
  return settings;
}

template <typename TInputImage, typename TOutputImage>
typename TOutputImage::Pointer
SubdividedBy(const std::string &                       target,
             const TInputImage *                       input,
             const Setting &                           setting,
             const typename TOutputImage::RegionType * region = nullptr)
{
  BoundaryConditions<TInputImage> boundaries;
  auto                            filter = itk::NonOscillatorySubdivisionImageFilter<TInputImage, TOutputImage>::New();
  filter->SetTarget(target);
  filter->SetScheme(setting.scheme);
  filter->SetBoundaryCondition(boundaries.Get(setting.boundary));
  SetAxes(filter.GetPointer(), setting.axes);
  filter->SetInput(input);
  if (region)
  {
    filter->GetOutput()->SetRequestedRegion(*region);
  }
  filter->Update();
  typename TOutputImage::Pointer output = filter->GetOutput();
  output->DisconnectPipeline();
  return output;
}

/** Real values: a few units in the last place of the range, here [-1, 1]. */
template <typename TImage>
testing::AssertionResult
AgreeWithin(const TImage * a, const TImage * b, double units)
{
  const double allowed = units * std::numeric_limits<typename TImage::PixelType>::epsilon();
  const double difference = LargestDifference(a, b);
  return difference <= allowed ? testing::AssertionSuccess()
                               : testing::AssertionFailure() << "differ by " << difference << " of " << allowed;
}

/** Integers: at most one apart, and only where the real value lies within `nearTie` of where rounding goes the other
 * way. */
template <typename TImage>
testing::AssertionResult
AgreeUpToTies(const TImage * a, const TImage * b, const DoubleImage * real, double nearTie)
{
  for (std::size_t i = 0; i < CountScalars(a); ++i)
  {
    const int    difference = std::abs(int{ ScalarsOf(a)[i] } - int{ ScalarsOf(b)[i] });
    const double value = ScalarsOf(real)[i];
    const double fromTie = std::abs(value - std::floor(value) - 0.5);
    if (difference > 1 || (difference == 1 && fromTie > nearTie))
    {
      return testing::AssertionFailure() << +ScalarsOf(a)[i] << " and " << +ScalarsOf(b)[i] << " for " << value;
    }
  }
  return testing::AssertionSuccess();
}

/** Skips its tests where there is nothing to compare. */
class NonOscillatorySubdivisionVectorTargets : public testing::Test
{
protected:
  void
  SetUp() override
  {
    if (VectorTargets().empty())
    {
      GTEST_SKIP() << "Only the portable kernel was built, or no other runs on this processor.";
    }
  }
};

/** Calls `check(target, input, setting)` for every target and every width from 1 to 70. */
template <typename TImage, typename TCheck>
void
ForEachTargetAndWidth(double low, double high, const TCheck & check)
{
  for (long width = 1; width <= 70; ++width)
  {
    const auto input = MakeImage<TImage>(MakeRegion<TImage>({ -3, 0, 5 }, { width, 1 + width % 5, 1 + width % 4 }));
    FillWithTestData(input.GetPointer(), low, high, static_cast<unsigned int>(width));
    for (const Setting & setting : SettingsFor(width))
    {
      for (const std::string & target : VectorTargets())
      {
        SCOPED_TRACE(testing::Message() << target << ", " << setting << ", width " << width);
        ASSERT_NO_FATAL_FAILURE(check(target, input.GetPointer(), setting));
      }
    }
  }
}

template <typename TImage>
void
ExpectRealsAgree(double units)
{
  ForEachTargetAndWidth<TImage>(-1.0, 1.0, [&](const auto & target, const TImage * input, const Setting & setting) {
    const auto portable = SubdividedBy<TImage, TImage>("portable", input, setting);
    const auto vector = SubdividedBy<TImage, TImage>(target, input, setting);
    ASSERT_TRUE(AgreeWithin<TImage>(vector, portable, units));
  });
}

template <typename TImage>
void
ExpectIntegersAgree(double low, double high, double nearTie)
{
  ForEachTargetAndWidth<TImage>(low, high, [&](const auto & target, const TImage * input, const Setting & setting) {
    const auto portable = SubdividedBy<TImage, TImage>("portable", input, setting);
    const auto vector = SubdividedBy<TImage, TImage>(target, input, setting);
    const auto real = SubdividedBy<TImage, DoubleImage>("portable", input, setting);
    ASSERT_TRUE(AgreeUpToTies<TImage>(vector, portable, real, nearTie));
  });
}

} // namespace

TEST(NonOscillatorySubdivisionTargets, PortableIsTheLast)
{
  const auto targets = itk::Subdivision::Target::GetNames();
  ASSERT_FALSE(targets.empty());
  EXPECT_EQ(targets.back(), "portable");
  EXPECT_EQ(itk::Subdivision::Target::Fastest().GetName(), targets.front());
}

TEST(NonOscillatorySubdivisionTargets, AreChosenByName)
{
  auto filter = FloatFilter::New();
  EXPECT_EQ(filter->GetTarget(), "");
  for (const std::string & target : itk::Subdivision::Target::GetNames())
  {
    filter->SetTarget(target);
    EXPECT_EQ(filter->GetTarget(), target);
  }
  const std::string last = filter->GetTarget();
  try
  {
    filter->SetTarget("abacus");
    FAIL() << "a target of no such name was accepted";
  }
  catch (const itk::ExceptionObject & error)
  {
    for (const std::string & target : itk::Subdivision::Target::GetNames())
    {
      EXPECT_NE(std::string(error.GetDescription()).find(target), std::string::npos) << error.GetDescription();
    }
  }
  EXPECT_EQ(filter->GetTarget(), last);
  filter->SetTarget("");
  EXPECT_EQ(filter->GetTarget(), "");
}

/** A filter that changes its target while another runs in another thread changes nothing of its result. */
TEST_F(NonOscillatorySubdivisionVectorTargets, BelongToOneFilter)
{
  const auto input = MakeImage<FloatImage>(MakeRegion<FloatImage>({ 0, 0, 0 }, { 90, 60, 50 }));
  FillWithTestData(input.GetPointer(), -1.0, 1.0, 0);
  const Setting     setting{ SchemeEnum::NonOscillatory, BoundaryKind::ZeroFlux, { true, true, true } };
  const auto        expected = SubdividedBy<FloatImage, FloatImage>("", input.GetPointer(), setting);
  std::atomic<bool> isDone{ false };
  std::thread       other([&] {
    auto small = FloatFilter::New();
    small->SetInput(
      ImageOf<FloatImage>(MakeRegion<FloatImage>({ 0, 0, 0 }, { 3, 3, 3 }), [](const auto &) { return 1; }));
    while (!isDone)
    {
      for (const std::string & target : itk::Subdivision::Target::GetNames())
      {
        small->SetTarget(target);
        small->Update();
      }
    }
  });
  for (int run = 0; run < 5; ++run)
  {
    const auto output = SubdividedBy<FloatImage, FloatImage>("", input.GetPointer(), setting);
    EXPECT_TRUE(SameBytes(output.GetPointer(), expected.GetPointer()));
  }
  isDone = true;
  other.join();
}

TEST_F(NonOscillatorySubdivisionVectorTargets, FloatsAgree) { ExpectRealsAgree<FloatImage>(8.0); }

TEST_F(NonOscillatorySubdivisionVectorTargets, DoublesAgree) { ExpectRealsAgree<DoubleImage>(8.0); }

TEST_F(NonOscillatorySubdivisionVectorTargets, EightBitIntegersAgree)
{
  ExpectIntegersAgree<ByteImage>(0.0, 255.0, 1e-3);
  ExpectIntegersAgree<SignedByteImage>(-128.0, 127.0, 1e-3);
}

TEST_F(NonOscillatorySubdivisionVectorTargets, SixteenBitIntegersAgree)
{
  ExpectIntegersAgree<ShortImage>(-1024.0, 1024.0, 1e-3);
  ExpectIntegersAgree<UShortImage>(0.0, 1024.0, 1e-3);
}

/** Towards the ends of 16 bits a unit in the last place of float is 1/256, so that 1e-3 is out of its reach. */
TEST_F(NonOscillatorySubdivisionVectorTargets, FullRangeOfSixteenBitsAgrees)
{
  ExpectIntegersAgree<ShortImage>(-32768.0, 32767.0, 8.0 / 256.0);
  ExpectIntegersAgree<UShortImage>(0.0, 65535.0, 8.0 / 256.0);
}

/** Every target, the portable one included: a part of the output has the bytes of the whole, wherever tiles, vectors
 * and their rests fall. */
TEST(NonOscillatorySubdivisionTargets, PartsAreThoseOfTheWhole)
{
  const auto bytes = MakeImage<ByteImage>(MakeRegion<ByteImage>({ 0, -4, 2 }, { 83, 19, 11 }));
  const auto floats = MakeImage<FloatImage>(MakeRegion<FloatImage>({ 7, 0, -1 }, { 75, 21, 9 }));
  FillWithTestData(bytes.GetPointer(), 0.0, 255.0, 0);
  FillWithTestData(floats.GetPointer(), -1.0, 1.0, 2);

  const auto expectParts = [](const std::string & target, const auto * image, const Setting & setting, unsigned seed) {
    using Image = std::remove_const_t<std::remove_pointer_t<decltype(image)>>;
    const auto   whole = SubdividedBy<Image, Image>(target, image, setting);
    std::mt19937 engine(seed);
    for (int trial = 0; trial < 6; ++trial)
    {
      const auto region = RandomSubRegion(whole->GetLargestPossibleRegion(), engine);
      const auto part = SubdividedBy<Image, Image>(target, image, setting, &region);
      ASSERT_EQ(part->GetBufferedRegion(), region);
      ASSERT_TRUE(SameBytesAsPartOf(part.GetPointer(), whole.GetPointer()))
        << target << ", " << setting << ", " << region;
    }
  };
  for (const std::string & target : itk::Subdivision::Target::GetNames())
  {
    for (const Setting & setting : SettingsFor(3))
    {
      ASSERT_NO_FATAL_FAILURE(expectParts(target, bytes.GetPointer(), setting, 1));
      ASSERT_NO_FATAL_FAILURE(expectParts(target, floats.GetPointer(), setting, 2));
    }
  }
}
