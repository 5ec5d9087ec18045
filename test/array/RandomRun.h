// SPDX-License-Identifier: Apache-2.0
#ifndef RandomRun_h
#define RandomRun_h

#include "SubdividerOracle.h"
#include "SubdividerTestHelpers.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <random>
#include <sstream>

/** A run from array to array of random sizes, first indices, element types, layouts and options. */
class RandomRun
{
public:
  using Box = itk::Subdivision::Box;
  using ElementType = itk::Subdivision::ElementType;

  enum class BoundaryKind
  {
    Nearest,
    Mirror,
    Periodic,
    Constant,
    Custom,
    ConstantOfEachComponent // along the first axis, which is not subdivided
  };

  /** \param mostAxes of the arrays
   * \param mostElements of the input */
  RandomRun(const unsigned int seed, const std::size_t mostAxes, const std::uint64_t mostElements)
    : Random(seed)
  {
    this->ChooseWhole(mostAxes, mostElements);
    this->ChooseAxes();
    this->ChooseScheme();
    const auto kind = static_cast<BoundaryKind>(this->Below(5));
    const bool hasComponents = !What.SubdividedAxes[0];
    this->SetBoundary(hasComponents && kind == BoundaryKind::Constant ? BoundaryKind::ConstantOfEachComponent : kind);
  }

  unsigned int
  Below(const std::size_t number)
  {
    return static_cast<unsigned int>(Random() % number);
  }

  ElementType
  MakeType()
  {
    return static_cast<ElementType>(this->Below(itk::Subdivision::NumberOfElementTypes));
  }

  ElementType
  MakeRealType()
  {
    return this->Below(2) == 0 ? ElementType::Float : ElementType::Double;
  }

  TestLayout
  MakeLayout()
  {
    TestLayout layout = TestLayout::Dense(Whole.size());
    if (this->Below(3) != 0)
    {
      std::shuffle(layout.Order.begin(), layout.Order.end(), Random);
      for (std::size_t axis = 0; axis < Whole.size(); ++axis)
      {
        layout.IsReversed[axis] = this->Below(2) == 0;
        layout.Free[axis] = this->Below(3);
      }
    }
    return layout;
  }

  /** A part of a box. */
  Box
  MakeBox(const Box & outer)
  {
    Box box;
    for (const auto & interval : outer)
    {
      const std::uint64_t skipped = this->Below(interval.Size);
      box.push_back({ interval.First + static_cast<std::int64_t>(skipped), 1 + this->Below(interval.Size - skipped) });
    }
    return box;
  }

  /** All of the input: integers that 8 bits have, with or without a sign. */
  TestArray
  MakeInput(const ElementType type)
  {
    TestArray input(type, Whole);
    FillWithSteps(input, Random);
    return input;
  }

  Box
  GetWholeOutput() const
  {
    return itk::Subdivision::Subdivider::GetWholeOutput(Whole, What.SubdividedAxes);
  }

  /** All children, dense in memory, in the type of the input. */
  TestArray
  Subdivide(const TestArray & input) const
  {
    return Subdivide(input, What);
  }

  static TestArray
  Subdivide(const TestArray & input, const itk::Subdivision::Options & options)
  {
    TestArray                   output(input.GetType(),
                     itk::Subdivision::Subdivider::GetWholeOutput(input.GetBox(), options.SubdividedAxes));
    itk::Subdivision::Workspace workspace;
    ::Subdivide(input, input.GetBox(), output, options, 1, workspace);
    return output;
  }

  /** The slow reference of it. */
  SubdividerOracle
  MakeOracle(const TestArray & input) const
  {
    return SubdividerOracle(input,
                            static_cast<SubdivisionReference::Scheme>(SchemeNumber),
                            What.Tension,
                            What.SubdividedAxes,
                            OracleBoundary);
  }

  void
  SetScheme(const unsigned int number)
  {
    constexpr double tensions[] = { 1.01, 1.25, 1.5, 2, 4, 8, 0, 0.5, 1 };
    SchemeNumber = number;
    What.Scheme = &itk::Subdivision::Schemes[number];
    const bool mayBeSmall = What.Scheme->Limited == itk::Subdivision::Correction::TowardsLinear;
    What.Tension = tensions[this->Below(mayBeSmall ? 9 : 6)];
  }

  void
  SetBoundary(BoundaryKind kind);

  std::string
  Describe() const
  {
    constexpr const char * boundaries[] = { "nearest",  "mirror",   "periodic",
                                            "constant", "by index", "constant of each component" };
    std::ostringstream     text;
    text << What.Scheme->Name << ", tension " << What.Tension << ", boundary " << boundaries[static_cast<int>(Kind)]
         << ", target " << What.Target->GetName() << ", first index:size";
    for (std::size_t axis = 0; axis < Whole.size(); ++axis)
    {
      text << ' ' << Whole[axis].First << ':' << Whole[axis].Size << (What.SubdividedAxes[axis] ? "" : " (kept)");
    }
    return text.str();
  }

  std::mt19937               Random;
  Box                        Whole;
  itk::Subdivision::Options  What;
  unsigned int               SchemeNumber{ 0 };
  BoundaryKind               Kind{ BoundaryKind::Nearest };
  SubdividerOracle::Boundary OracleBoundary;

private:
  /** A value for every index, which no rule of Boundary's gives. */
  static double
  GetOutsideValue(const std::int64_t * const index, const std::size_t axes)
  {
    std::int64_t sum = 3;
    for (std::size_t axis = 0; axis < axes; ++axis)
    {
      sum = 7 * sum + index[axis];
    }
    return static_cast<double>(((sum % 61) + 61) % 61);
  }

  class OutsideValues final : public itk::Subdivision::OutsideElements
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

  /** Some axes are long, so that there are rows of several vectors. */
  void
  ChooseWhole(const std::size_t mostAxes, const std::uint64_t mostElements)
  {
    Whole.resize(1 + this->Below(mostAxes));
    std::uint64_t elements = 1;
    for (auto & interval : Whole)
    {
      const std::uint64_t most = std::min<std::uint64_t>(40, std::max<std::uint64_t>(mostElements / elements, 1));
      interval.Size = 1 + this->Below(most);
      elements *= interval.Size;
    }
    std::shuffle(Whole.begin(), Whole.end(), Random);
    for (auto & interval : Whole)
    {
      interval.First = static_cast<std::int64_t>(this->Below(81)) - 40;
    }
  }

  void
  ChooseAxes()
  {
    auto & flags = What.SubdividedAxes;
    while (flags.size() < Whole.size())
    {
      flags.push_back(this->Below(4) != 0 && std::count(flags.begin(), flags.end(), true) < 3);
    }
  }

  void
  ChooseScheme()
  {
    this->SetScheme(this->Below(std::size(itk::Subdivision::Schemes)));
    const auto targets = itk::Subdivision::Target::GetNames();
    What.Target = &itk::Subdivision::Target::Named(targets[this->Below(targets.size())]);
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
};

inline void
RandomRun::SetBoundary(const BoundaryKind kind)
{
  using itk::Subdivision::Boundary;
  namespace ref = SubdivisionReference;
  constexpr unsigned int dimension = SubdividerOracle::Dimension;
  Kind = kind;
  switch (kind)
  {
    case BoundaryKind::Nearest:
      What.Boundary = Boundary::Nearest();
      OracleBoundary = ref::ZeroFlux<dimension>();
      break;
    case BoundaryKind::Mirror:
      What.Boundary = Boundary::Mirror();
      OracleBoundary = ref::Mirror<dimension>();
      break;
    case BoundaryKind::Periodic:
      What.Boundary = Boundary::Periodic();
      OracleBoundary = ref::Periodic<dimension>();
      break;
    case BoundaryKind::Constant:
    case BoundaryKind::ConstantOfEachComponent:
    {
      const bool          isOfEach = Kind == BoundaryKind::ConstantOfEachComponent;
      std::vector<double> constants;
      for (std::uint64_t i = 0; i < (isOfEach ? Whole[0].Size : 1); ++i)
      {
        constants.push_back(5.0 + 10.0 * static_cast<double>(i % 11));
      }
      What.Boundary = Boundary::Constant(constants);
      OracleBoundary = Outside(
        [constants, isOfEach](const SubdividerOracle::Index & index) { return constants[isOfEach ? index[0] : 0]; });
      break;
    }
    default:
      What.Boundary = Boundary::Custom(std::make_shared<OutsideValues>(Whole.size()));
      OracleBoundary = Outside([whole = Whole](const SubdividerOracle::Index & index) {
        TestArray::Index position;
        for (std::size_t axis = 0; axis < whole.size(); ++axis)
        {
          position.push_back(index[axis] + whole[axis].First);
        }
        return GetOutsideValue(position.data(), position.size());
      });
  }
}

#endif
