// SPDX-License-Identifier: Apache-2.0
// The kernel and the array layer on runs that a fuzzer makes up: sizes, layouts in memory, element types, values,
// schemes, tensions, boundaries, boxes, threads and targets. Some children of each run are held to the slow reference,
// and the box that was asked for to the same box of a run of all.

#include "FuzzBytes.h"

#include "SubdividerTestHelpers.h"
#include "SubdivisionReference.h"

#include <cmath>
#include <limits>
#include <utility>

namespace
{

using namespace itk::Subdivision;
namespace Reference = SubdivisionReference;

constexpr unsigned int MostAxes = 3;
using Index3 = Reference::Index<MostAxes>;
using Grid3 = Reference::Grid<MostAxes>;

class FuzzedRun
{
public:
  explicit FuzzedRun(FuzzBytes & bytes)
    : m_Bytes(bytes)
    , m_Whole(this->ChooseWhole())
    , m_InputType(this->ChooseType())
    , m_OutputType(this->ChooseType())
    , m_Input(m_InputType, m_Whole)
  {
    // The bytes of a child depend on the order of the input in memory, so that all runs have the same.
    m_InputLayout = this->ChooseLayout();
    this->ChooseOptions();
    this->FillInput();
  }

  void
  Check()
  {
    const Box all = Subdivider::GetWholeOutput(m_Whole, m_Options.SubdividedAxes);
    const Box box = this->ChooseBox(all);
    TestArray part(m_OutputType, box, this->ChooseLayout());
    this->Run(box, part, 1 + m_Bytes.Below(3));
    if (m_IsFinite)
    {
      this->CompareWithReference(box, part);
    }
    if (m_Bytes.Below(4) == 0)
    {
      TestArray whole(m_OutputType, all);
      this->Run(all, whole, 1);
      TestArray::ForEachIndex(box, [&](const TestArray::Index & index) {
        FuzzExpect(part.GetBytes(index) == whole.GetBytes(index), "a part has other bytes than the whole");
      });
    }
  }

private:
  Box
  ChooseWhole()
  {
    // The reference is slow along three axes, and most of what can go wrong does so along one.
    const unsigned int kind = m_Bytes.Below(32);
    Box                whole(kind < 20 ? 1 : kind < 31 ? 2 : 3);
    const std::size_t  longAxis = m_Bytes.Below(whole.size());
    for (std::size_t axis = 0; axis < whole.size(); ++axis)
    {
      const std::uint64_t longest = axis == longAxis ? 80 : 5;
      whole[axis] = { static_cast<std::int64_t>(m_Bytes.Byte()) - 128, 1 + m_Bytes.Below(longest) };
    }
    return whole;
  }

  ElementType
  ChooseType()
  {
    return static_cast<ElementType>(m_Bytes.Below(NumberOfElementTypes));
  }

  TestLayout
  ChooseLayout()
  {
    TestLayout layout = TestLayout::Dense(m_Whole.size());
    for (std::size_t axis = 0; axis < m_Whole.size(); ++axis)
    {
      std::swap(layout.Order[axis], layout.Order[m_Bytes.Below(axis + 1)]);
      layout.IsReversed[axis] = m_Bytes.Below(2) == 1;
      layout.Free[axis] = static_cast<std::ptrdiff_t>(m_Bytes.Below(3));
    }
    return layout;
  }

  Box
  ChooseBox(const Box & outer)
  {
    Box box;
    for (const Interval & interval : outer)
    {
      const std::uint64_t skipped = m_Bytes.Below(interval.Size);
      box.push_back(
        { interval.First + static_cast<std::int64_t>(skipped), 1 + m_Bytes.Below(interval.Size - skipped) });
    }
    return box;
  }

  void
  ChooseOptions()
  {
    const bool isReal = !IsInteger(m_InputType) && !IsInteger(m_OutputType);
    m_Scale = isReal ? std::ldexp(1.0, static_cast<int>(m_Bytes.Below(81)) - 40) : 1.0;
    constexpr double tensions[] = { 1.01, 1.25, 2.0, 4.0, 8.0 };
    for (std::size_t axis = 0; axis < m_Whole.size(); ++axis)
    {
      m_Options.SubdividedAxes.push_back(m_Bytes.Below(4) != 0);
    }
    m_Scheme = m_Bytes.Below(std::size(Schemes));
    m_Options.Scheme = &Schemes[m_Scheme];
    m_Options.Tension = tensions[m_Bytes.Below(std::size(tensions))];
    const std::vector<std::string> targets = Target::GetNames();
    m_Options.Target = &Target::Named(targets[m_Bytes.Below(targets.size())]);
    switch (m_Bytes.Below(4))
    {
      case 0:
        m_Boundary = Reference::ZeroFlux<MostAxes>();
        break;
      case 1:
        m_Options.Boundary = Boundary::Mirror();
        m_Boundary = Reference::Mirror<MostAxes>();
        break;
      case 2:
        m_Options.Boundary = Boundary::Periodic();
        m_Boundary = Reference::Periodic<MostAxes>();
        break;
      default:
        m_Options.Boundary = Boundary::Constant({ 7.0 * m_Scale });
        m_Boundary = Reference::Constant<MostAxes>(7.0 * m_Scale);
    }
  }

  /** Integers that all types hold, which real types may have scaled; sometimes NaN and infinities among them. */
  void
  FillInput()
  {
    const bool hasOthers = !IsInteger(m_InputType) && m_Bytes.Below(8) == 0;
    m_Values = m_Bytes.Rest();
    std::size_t next = 0;
    TestArray::ForEachIndex(m_Whole, [&](const TestArray::Index & index) {
      const auto byte = m_Values.empty() ? 0u : static_cast<unsigned char>(m_Values[next++ % m_Values.size()]);
      double     value = m_Scale * static_cast<double>(byte % 128);
      if (hasOthers && byte >= 250)
      {
        value = byte >= 253 ? std::numeric_limits<double>::quiet_NaN() : std::numeric_limits<double>::infinity();
        m_IsFinite = false;
      }
      m_Input.Set(index, value);
    });
    // The choices that come after are made by the same bytes.
    m_Bytes = FuzzBytes(reinterpret_cast<const std::uint8_t *>(m_Values.data()), m_Values.size());
  }

  void
  Run(const Box & box, TestArray & output, const unsigned int threads)
  {
    const Box       request = Subdivider::GetInputRequest(box, m_Whole, m_Options);
    const TestArray input = Cut(m_Input, request, m_InputLayout);
    Workspace       workspace;
    const auto      written = Subdivide(input, m_Whole, output, m_Options, threads, workspace);
    FuzzExpect(written == CountElements(box), "not every element was written");
  }

  void
  CompareWithReference(const Box & box, const TestArray & output)
  {
    Index3 size;
    size.fill(1);
    for (std::size_t axis = 0; axis < m_Whole.size(); ++axis)
    {
      size[axis] = static_cast<long>(m_Whole[axis].Size);
    }
    const Grid3 image = Reference::MakeGrid<MostAxes>(Index3{}, size, [&](const Index3 & index) {
      TestArray::Index position;
      for (std::size_t axis = 0; axis < m_Whole.size(); ++axis)
      {
        position.push_back(index[axis] + m_Whole[axis].First);
      }
      return m_Input.Get(position);
    });
    for (int i = 0; i < 2; ++i)
    {
      TestArray::Index index;
      for (const Interval & interval : box)
      {
        index.push_back(interval.First + static_cast<std::int64_t>(m_Bytes.Below(interval.Size)));
      }
      this->CompareChild(image, index, output.Get(index));
    }
  }

  /** The reference of a child's parent alone: all others are its boundary. */
  void
  CompareChild(const Grid3 & image, const TestArray::Index & index, const double computed) const
  {
    Index3                        parent{};
    Index3                        child{};
    Reference::Settings<MostAxes> settings;
    settings.axes.fill(false);
    for (std::size_t axis = 0; axis < index.size(); ++axis)
    {
      const bool isSubdivided = m_Options.SubdividedAxes[axis];
      const long place = static_cast<long>(index[axis] - (isSubdivided ? 2 : 1) * m_Whole[axis].First);
      settings.axes[axis] = isSubdivided;
      parent[axis] = isSubdivided ? place / 2 : place;
      child[axis] = isSubdivided ? place % 2 : 0;
    }
    settings.scheme = static_cast<Reference::Scheme>(m_Scheme);
    settings.tension = m_Options.Tension;
    settings.boundary = [&](const Grid3 &, const Index3 & offset) {
      return m_Boundary(image, Reference::Sum<MostAxes>(parent, offset));
    };
    Index3 one;
    one.fill(1);
    const Reference::Subdivision<MostAxes> reference(Grid3(Index3{}, one), settings);

    const double expected = Saturate(reference.At(child), m_OutputType);
    const bool   isDouble = NeedsDouble(m_InputType) || NeedsDouble(m_OutputType);
    // Some units in the last place of values of up to 127, and half an integer where they are rounded.
    const double tolerance =
      m_Scale * (isDouble && m_OutputType != ElementType::Float ? 1e-11 : 2e-4) + (IsInteger(m_OutputType) ? 0.5 : 0.0);
    FuzzExpect(std::abs(computed - expected) <= tolerance,
               std::to_string(computed / m_Scale) + " where the reference has " + std::to_string(expected / m_Scale) +
                 ", off by " + std::to_string(std::abs(computed - expected) / tolerance) +
                 " of what is allowed, scheme " + Schemes[m_Scheme].Name + ", " + GetName(m_InputType) + " to " +
                 GetName(m_OutputType));
  }

  static double
  Saturate(const double value, const ElementType type)
  {
    return WithElementType(type, [value](const auto tag) {
      using Limits = std::numeric_limits<typename decltype(tag)::Type>;
      return std::clamp(value, static_cast<double>(Limits::lowest()), static_cast<double>(Limits::max()));
    });
  }

  FuzzBytes &                   m_Bytes;
  std::string                   m_Values;
  Box                           m_Whole;
  ElementType                   m_InputType;
  ElementType                   m_OutputType;
  TestArray                     m_Input;
  TestLayout                    m_InputLayout;
  Options                       m_Options;
  unsigned int                  m_Scheme = 0;
  Reference::Boundary<MostAxes> m_Boundary;
  double                        m_Scale = 1.0;
  bool                          m_IsFinite = true;
};

} // namespace

int
LLVMFuzzerTestOneInput(const std::uint8_t * const data, const std::size_t size)
{
  FuzzBytes bytes(data, size);
  FuzzedRun(bytes).Check();
  return 0;
}
