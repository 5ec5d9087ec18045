// SPDX-License-Identifier: Apache-2.0
#include "SubdivisionKernelTiles.h"

// Children as elements: every type, on every target, at any width, from rows whose lanes are in the kernel's own order.

namespace
{
using namespace SubdivisionKernelTiles;

/** The element for a value, by means of the standard library. */
template <typename TElement, typename T>
TElement
ToElement(const T value)
{
  if constexpr (std::is_floating_point<TElement>::value)
  {
    return static_cast<TElement>(value);
  }
  else
  {
    using Limits = std::numeric_limits<TElement>;
    if (std::isnan(value))
    {
      return 0;
    }
    const long double rounded = std::nearbyint(static_cast<long double>(value));
    return rounded >= static_cast<long double>(Limits::max())      ? Limits::max()
           : rounded <= static_cast<long double>(Limits::lowest()) ? Limits::lowest()
                                                                   : static_cast<TElement>(rounded);
  }
}

/** What must have been among the children for a test of conversions to mean anything. */
struct Seen
{
  bool NotANumber{ false };
  bool Infinite{ false };
  bool MinusInfinite{ false };
  bool TieToEvenBelow{ false };
  bool TieToEvenAbove{ false };
  bool NegativeTie{ false };

  void
  Add(const double value)
  {
    NotANumber |= std::isnan(value);
    Infinite |= value == std::numeric_limits<double>::infinity();
    MinusInfinite |= value == -std::numeric_limits<double>::infinity();
    TieToEvenBelow |= value == 2.5;
    TieToEvenAbove |= value == 1.5;
    NegativeTie |= value == -2.5;
  }

  bool
  All() const
  {
    return NotANumber && Infinite && MinusInfinite && TieToEvenBelow && TieToEvenAbove && NegativeTie;
  }
};

/** Compares the elements that a row becomes with those of its own values. */
template <typename T>
class ConvertingSink : public RowSink<T>
{
public:
  void
  WriteRow(std::ptrdiff_t, std::ptrdiff_t, const ChildRow<T> & children) override
  {
    std::vector<T> values(children.GetSize());
    children.CopyTo(ElementTypeOf<T>(), values.data());
    for (const T value : values)
    {
      Children.Add(static_cast<double>(value));
    }
    for (std::size_t type = 0; type < NumberOfElementTypes; ++type)
    {
      WithElementType(static_cast<ElementType>(type),
                      [&](const auto tag) { this->template Expect<typename decltype(tag)::Type>(values, children); });
    }
  }

  Seen Children;

private:
  template <typename TElement>
  void
  Expect(const std::vector<T> & values, const ChildRow<T> & children) const
  {
    const std::size_t     size = values.size();
    const auto            guard = TElement(55);
    std::vector<TElement> elements(size + 1, guard);
    children.CopyTo(ElementTypeOf<TElement>(), elements.data());
    for (std::size_t i = 0; i < size; ++i)
    {
      const auto expected = ToElement<TElement>(values[i]);
      const bool isSame = expected == elements[i] || (expected != expected && elements[i] != elements[i]);
      ASSERT_TRUE(isSame) << +expected << " " << +elements[i] << " of " << values[i] << ", element " << i << " of "
                          << size << ", " << GetName(ElementTypeOf<TElement>());
    }
    ASSERT_EQ(guard, elements[size]);
  }
};

/** Runs of equal values, whose inner children are that value: where they end, children lie between and beyond. */
template <typename T>
void
FillWithRuns(TestTile<T> & tile, std::mt19937 & generator)
{
  const T        largest = std::numeric_limits<T>::max();
  std::vector<T> levels{ 0, T(0.5), T(1.5), T(2.5), T(-0.5), T(-1.5), T(-2.5), largest, -largest };
  const double   ends[] = { 127, -128, 255, 32767, -32768, 65535, 2147483647., -2147483648., 4294967295. };
  const double   beyond64[] = { 9.2e18, -9.2e18, 9.3e18, -9.3e18, 1.84e19, 1.85e19, 1e30 };
  levels.push_back(std::numeric_limits<T>::quiet_NaN());
  for (const double end : ends)
  {
    for (const double offset : { -0.75, -0.5, 0.0, 0.5, 1.0 })
    {
      levels.push_back(static_cast<T>(end + offset));
    }
  }
  levels.insert(levels.end(), std::begin(beyond64), std::end(beyond64));
  std::size_t left = 0;
  T           level = 0;
  for (double & value : tile.Values.values)
  {
    if (left-- == 0)
    {
      left = generator() % 14;
      level = levels[generator() % levels.size()];
    }
    value = level;
  }
}

template <typename T>
class SubdivisionKernelConversion : public ::testing::Test
{};
using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SubdivisionKernelConversion, Reals);

/** x is subdivided, so lower and upper children lie in vectors of their own, or carried, so rows are plain. */
TYPED_TEST(SubdivisionKernelConversion, RoundsAndSaturatesAtAnyWidth)
{
  const Scheme & linear = FindScheme("linear");
  for (const Axes & axes : { Axes{ true, false, false }, Axes{ false, false, true } })
  {
    for (const std::string & target : Target::GetNames())
    {
      SCOPED_TRACE(target);
      std::mt19937              generator(17);
      ConvertingSink<TypeParam> sink;
      for (std::size_t width = 1; width <= 70; ++width)
      {
        TestTile<TypeParam> tile(linear, axes, { width, 5, 4 });
        FillWithRuns(tile, generator);
        Kernel<TypeParam> kernel(linear, 2, axes, tile.Size, Target::Named(target));
        kernel.Subdivide(tile.Size, tile, sink);
      }
      EXPECT_TRUE(!axes.X || sink.Children.All());
    }
  }
}

} // namespace
