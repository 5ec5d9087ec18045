// SPDX-License-Identifier: Apache-2.0
// The kernel and the array layer on runs that a fuzzer makes up: sizes, layouts in memory, element types, values,
// schemes, tensions, boundaries, boxes, threads and targets. A child of nearly each run is held to the slow reference,
// and the box that was asked for to the same box of a run of all.

#include "FuzzBytes.h"
#include "FuzzedReference.h"

#include "array/SubdividerTestHelpers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace
{

using namespace itk::Subdivision;
using FuzzedReference::Grid3;
using FuzzedReference::Index3;

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
    // To start a thread takes longer than all else.
    this->Run(box, part, m_Bytes.Below(16) == 15 ? 2 : 1);
    // Along three axes at once, the reference takes longer than a hundred other runs.
    const auto & axes = m_Reference.axes;
    const bool   isSlow = std::count(axes.begin(), axes.end(), true) == 3;
    if (m_IsFinite && (!isSlow || m_Bytes.Below(16) == 15))
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
    // The reference is slow along three axes, and most of what can go wrong does so along one. Some hundred children
    // have it all: the insides of the stencils, and both ends. Few runs are so long that they are cut into tiles.
    const unsigned int    kind = m_Bytes.Below(64);
    Box                   whole(kind < 48 ? 1 : kind < 63 ? 2 : 3);
    constexpr std::size_t longestRuns[] = { 40, 16, 12 };
    const std::size_t     longAxis = m_Bytes.Below(whole.size());
    const std::uint64_t   times = m_Bytes.Below(64) == 63 ? 32 : 1;
    for (std::size_t axis = 0; axis < whole.size(); ++axis)
    {
      const bool          isLong = axis == longAxis;
      const std::uint64_t size = 1 + m_Bytes.Below(isLong ? longestRuns[whole.size() - 1] : 4);
      whole[axis] = { static_cast<std::int64_t>(m_Bytes.Byte()) - 128, isLong ? size * times : size };
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
      const std::uint64_t skipped = m_Bytes.UpTo(interval.Size - 1);
      box.push_back(
        { interval.First + static_cast<std::int64_t>(skipped), 1 + m_Bytes.UpTo(interval.Size - skipped - 1) });
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
    m_Reference.scheme = static_cast<SubdivisionReference::Scheme>(m_Scheme);
    m_Reference.tension = m_Options.Tension;
    m_Reference.axes.fill(false);
    std::copy(m_Options.SubdividedAxes.begin(), m_Options.SubdividedAxes.end(), m_Reference.axes.begin());
    this->ChooseBoundary();
  }

  void
  ChooseBoundary()
  {
    const unsigned int kind = m_Bytes.Below(4);
    const double       constant = 7.0 * m_Scale;
    m_Reference.boundary = FuzzedReference::MakeBoundary(kind, constant);
    if (kind == 1)
    {
      m_Options.Boundary = Boundary::Mirror();
    }
    else if (kind == 2)
    {
      m_Options.Boundary = Boundary::Periodic();
    }
    else if (kind == 3)
    {
      m_Options.Boundary = Boundary::Constant({ constant });
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
    const TestArray input = Cut(m_Input, request, this->GetLayoutOf(request));
    const auto      written = Subdivide(input, m_Whole, output, m_Options, threads, m_Workspace);
    FuzzExpect(written == CountElements(box), "not every element was written");
  }

  /** How a part of the input lies in memory. Where an axis that is not subdivided has one element, its stride alone
   * tells its place among the axes. */
  TestLayout
  GetLayoutOf(const Box & part) const
  {
    TestLayout layout = m_InputLayout;
    for (std::size_t axis = 0; axis < part.size(); ++axis)
    {
      const bool isPlaced = m_Options.SubdividedAxes[axis] || part[axis].Size > 1;
      layout.Free[axis] = std::max<std::ptrdiff_t>(layout.Free[axis], isPlaced ? 0 : 1);
    }
    return layout;
  }

  /** The image for the reference, its first index at 0. */
  Grid3
  MakeImage() const
  {
    Index3 size;
    size.fill(1);
    for (std::size_t axis = 0; axis < m_Whole.size(); ++axis)
    {
      size[axis] = static_cast<long>(m_Whole[axis].Size);
    }
    TestArray::Index position(m_Whole.size());
    return SubdivisionReference::MakeGrid<FuzzedReference::MostAxes>(Index3{}, size, [&](const Index3 & index) {
      for (std::size_t axis = 0; axis < m_Whole.size(); ++axis)
      {
        position[axis] = index[axis] + m_Whole[axis].First;
      }
      return m_Input.Get(position);
    });
  }

  void
  CompareWithReference(const Box & box, const TestArray & output)
  {
    TestArray::Index index;
    Index3           child{};
    for (std::size_t axis = 0; axis < box.size(); ++axis)
    {
      index.push_back(box[axis].First + static_cast<std::int64_t>(m_Bytes.UpTo(box[axis].Size - 1)));
      child[axis] = static_cast<long>(index[axis] - (m_Reference.axes[axis] ? 2 : 1) * m_Whole[axis].First);
    }
    const double computed = output.Get(index);
    const double expected = Saturate(FuzzedReference::GetChild(this->MakeImage(), m_Reference, child), m_OutputType);
    const bool   isDouble = NeedsDouble(m_InputType) || NeedsDouble(m_OutputType);
    // Some units in the last place of values of up to 127, and half an integer where they are rounded.
    const double tolerance =
      m_Scale * (isDouble && m_OutputType != ElementType::Float ? 1e-11 : 2e-4) + (IsInteger(m_OutputType) ? 0.5 : 0.0);
    if (!(std::abs(computed - expected) <= tolerance))
    {
      FuzzExpect(false,
                 std::to_string(computed / m_Scale) + " where the reference has " + std::to_string(expected / m_Scale) +
                   ", off by " + std::to_string(std::abs(computed - expected) / tolerance) +
                   " of what is allowed, scheme " + Schemes[m_Scheme].Name + ", " + GetName(m_InputType) + " to " +
                   GetName(m_OutputType));
    }
  }

  static double
  Saturate(const double value, const ElementType type)
  {
    return WithElementType(type, [value](const auto tag) {
      using Limits = std::numeric_limits<typename decltype(tag)::Type>;
      return std::clamp(value, static_cast<double>(Limits::lowest()), static_cast<double>(Limits::max()));
    });
  }

  FuzzBytes &               m_Bytes;
  std::string               m_Values;
  Box                       m_Whole;
  ElementType               m_InputType;
  ElementType               m_OutputType;
  TestArray                 m_Input;
  TestLayout                m_InputLayout;
  Workspace                 m_Workspace;
  Options                   m_Options;
  FuzzedReference::Settings m_Reference;
  unsigned int              m_Scheme = 0;
  double                    m_Scale = 1.0;
  bool                      m_IsFinite = true;
};

} // namespace

int
LLVMFuzzerTestOneInput(const std::uint8_t * const data, const std::size_t size)
{
  FuzzBytes bytes(data, size);
  FuzzedRun(bytes).Check();
  return 0;
}
