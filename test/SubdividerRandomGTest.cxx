// SPDX-License-Identifier: Apache-2.0
#include "SubdividerOracle.h"
#include "SubdividerTestHelpers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

namespace
{

using namespace itk::Subdivision;

constexpr std::size_t MostAxes = SubdividerOracle::Dimension;

/** A value for every index, which no rule of Boundary's gives. */
double
GetOutsideValue(const std::int64_t * const index, const std::size_t axes)
{
  std::int64_t sum = 3;
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    sum = 7 * sum + index[axis];
  }
  return static_cast<double>(((sum % 61) + 61) % 61);
}

class OutsideValues final : public OutsideElements
{
public:
  explicit OutsideValues(const std::size_t axes)
    : m_Axes(axes)
  {}

  double
  GetElement(const std::int64_t * const index) const override
  {
    return GetOutsideValue(index, m_Axes);
  }

private:
  std::size_t m_Axes;
};

/** A run of random sizes, types, layouts and options. */
class RandomRun
{
public:
  explicit RandomRun(const unsigned int seed)
    : m_Random(seed)
    , m_Whole(this->Below(MostAxes) + 1)
    , m_Input(this->MakeInput())
  {
    this->ChooseOptions();
    this->ChooseBoundary();
  }

  /** Compares a random box of the output, made from no more than what is requested, with the reference. */
  void
  Check()
  {
    const Box       box = this->MakeBox(Subdivider::GetWholeOutput(m_Whole, m_Options.SubdividedAxes));
    const Box       request = Subdivider::GetInputRequest(box, m_Whole, m_Options);
    const TestArray input = Cut(m_Input, request, this->MakeLayout());
    TestArray       output(this->MakeType(), box, this->MakeLayout());
    Workspace       workspace;
    const auto      written = Subdivide(input, m_Whole, output, m_Options, 1 + this->Below(3), workspace);
    EXPECT_EQ(written, CountElements(box));

    const SubdividerOracle oracle(
      m_Input, m_Reference, m_Options.Tension, m_Options.SubdividedAxes, m_ReferenceBoundary);
    const bool isReal = output.GetType() == ElementType::Float || output.GetType() == ElementType::Double;
    const bool isDouble = NeedsDouble(input.GetType()) || NeedsDouble(output.GetType());
    // Values are a few hundreds at most: some units in the last place, and half an integer where they are rounded.
    const double tolerance = (isDouble && output.GetType() != ElementType::Float ? 1e-11 : 2e-4) + (isReal ? 0.0 : 0.5);
    TestArray::ForEachIndex(box, [&](const TestArray::Index & index) {
      EXPECT_NEAR(output.Get(index), this->Saturate(oracle.At(index), output.GetType()), tolerance);
    });
  }

private:
  unsigned int
  Below(const std::size_t number)
  {
    return static_cast<unsigned int>(m_Random() % number);
  }

  ElementType
  MakeType()
  {
    return static_cast<ElementType>(this->Below(10));
  }

  /** Some axes are long, so that there are rows of several vectors. */
  TestArray
  MakeInput()
  {
    const std::size_t longAxis = this->Below(m_Whole.size());
    for (std::size_t axis = 0; axis < m_Whole.size(); ++axis)
    {
      const std::uint64_t size = 1 + this->Below(m_Whole.size() > 3 ? 4 : 6);
      m_Whole[axis] = { static_cast<std::int64_t>(this->Below(41)) - 20, axis == longAxis ? 9 * size : size };
    }
    TestArray input(this->MakeType(), m_Whole);
    FillWithSteps(input, m_Random);
    return input;
  }

  TestLayout
  MakeLayout()
  {
    TestLayout layout = TestLayout::Dense(m_Whole.size());
    if (this->Below(3) != 0)
    {
      std::shuffle(layout.Order.begin(), layout.Order.end(), m_Random);
      for (std::size_t axis = 0; axis < m_Whole.size(); ++axis)
      {
        layout.IsReversed[axis] = this->Below(2) == 0;
        layout.Free[axis] = this->Below(3);
      }
    }
    return layout;
  }

  Box
  MakeBox(const Box & outer)
  {
    Box box;
    for (const Interval & interval : outer)
    {
      const std::uint64_t skipped = this->Below(interval.Size);
      box.push_back({ interval.First + static_cast<std::int64_t>(skipped), 1 + this->Below(interval.Size - skipped) });
    }
    return box;
  }

  void
  ChooseOptions()
  {
    Flags & flags = m_Options.SubdividedAxes;
    for (std::size_t axis = 0; axis < m_Whole.size(); ++axis)
    {
      flags.push_back(this->Below(3) != 0 && std::count(flags.begin(), flags.end(), true) < 3);
    }
    const unsigned int scheme = this->Below(std::size(Schemes));
    m_Options.Scheme = &Schemes[scheme];
    m_Reference = static_cast<SubdivisionReference::Scheme>(scheme);
    m_Options.Tension = 1.25 + this->Below(4);
  }

  void
  ChooseBoundary()
  {
    constexpr unsigned int dimension = SubdividerOracle::Dimension;
    switch (this->Below(5))
    {
      case 0:
        m_ReferenceBoundary = SubdivisionReference::ZeroFlux<dimension>();
        break;
      case 1:
        m_Options.Boundary = Boundary::Mirror();
        m_ReferenceBoundary = SubdivisionReference::Mirror<dimension>();
        break;
      case 2:
        m_Options.Boundary = Boundary::Periodic();
        m_ReferenceBoundary = SubdivisionReference::Periodic<dimension>();
        break;
      case 3:
        this->ChooseConstants();
        break;
      default:
        m_Options.Boundary = Boundary::Custom(std::make_shared<OutsideValues>(m_Whole.size()));
        m_ReferenceBoundary = Outside([whole = m_Whole](const SubdividerOracle::Index & index) {
          TestArray::Index position;
          for (std::size_t axis = 0; axis < whole.size(); ++axis)
          {
            position.push_back(index[axis] + whole[axis].First);
          }
          return GetOutsideValue(position.data(), position.size());
        });
    }
  }

  void
  ChooseConstants()
  {
    const bool          isVector = !m_Options.SubdividedAxes[0];
    std::vector<double> constants;
    for (std::uint64_t i = 0; i < (isVector ? m_Whole[0].Size : 1); ++i)
    {
      constants.push_back(10.0 * static_cast<double>(i) + 5.0);
    }
    m_Options.Boundary = Boundary::Constant(constants);
    m_ReferenceBoundary = Outside(
      [constants, isVector](const SubdividerOracle::Index & index) { return constants[isVector ? index[0] : 0]; });
  }

  /** The image within it, a function of the index without. */
  template <typename TFunction>
  static SubdividerOracle::Boundary
  Outside(const TFunction & function)
  {
    return [function](const SubdividerOracle::Grid & image, const SubdividerOracle::Index & index) {
      for (unsigned int axis = 0; axis < SubdividerOracle::Dimension; ++axis)
      {
        if (index[axis] < 0 || index[axis] >= image.size[axis])
        {
          return function(index);
        }
      }
      return image(index);
    };
  }

  static double
  Saturate(const double value, const ElementType type)
  {
    return WithElementType(type, [value](const auto tag) {
      using Limits = std::numeric_limits<typename decltype(tag)::Type>;
      return std::clamp(value, static_cast<double>(Limits::lowest()), static_cast<double>(Limits::max()));
    });
  }

  std::mt19937                 m_Random;
  Box                          m_Whole;
  TestArray                    m_Input;
  Options                      m_Options;
  SubdivisionReference::Scheme m_Reference{};
  SubdividerOracle::Boundary   m_ReferenceBoundary;
};

TEST(SubdividerRandom, AgreesWithTheReference)
{
  for (unsigned int seed = 0; seed < 300 && !HasFailure(); ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomRun(seed).Check();
  }
}

} // namespace
