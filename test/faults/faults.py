# SPDX-License-Identifier: Apache-2.0
"""The faults that scripts/plant_faults.py plants: what somebody might get wrong in a line."""
from typing import NamedTuple


class Fault(NamedTuple):
    """A text that stands in a file exactly once, and what is put in its place."""

    name: str
    file: str
    text: str
    replacement: str
    target: str = "ArrayTests"


SCHEME = "include/NonOscillatorySubdivision/Scheme.h"
STAGES = "src/kernel/stages/"
VECTORS = "src/kernel/vectors/"

FAULTS = [
    # Masks, radii, and where the children lie.
    Fault("mask: a B-spline tap is off by one", SCHEME, "{ 11, 165, 462, 330, 55, 1 }", "{ 11, 165, 463, 329, 55, 1 }"),
    Fault("mask: a linear tap is off by one", SCHEME, "{ 14, -126, 924, 276, -74, 10 }", "{ 14, -126, 925, 276, -75, 10 }"),
    Fault("mask: a tap of second differences is off by one", SCHEME, "{ 3, -285, -111, 9 }", "{ 3, -284, -111, 9 }"),
    Fault("mask: both children change places", STAGES + "SeparablePasses-inl.h",
          "children(x, Add(even, lower), Add(even, upper));", "children(x, Add(even, upper), Add(even, lower));"),
    Fault("mask: the outermost tap of the lower child", STAGES + "SeparablePasses-inl.h",
          "MulSub(outer, values(x, -3), odd)", "MulSub(outer, values(x, -2), odd)"),
    Fault("radius: the window of a threshold is narrower", STAGES + "Rows-inl.h",
          "MinNonNegative(sums(x, 1), sums(x, 2))", "MinNonNegative(sums(x, 1), sums(x, 1))"),
    Fault("radius: the stencil is one voxel short", "src/array/Geometry.cxx",
          "CheckedAdd(GetParent(lastChild), radius)", "CheckedAdd(GetParent(lastChild), radius - 1)"),
    Fault("radius: the stencil is one voxel too long", "src/array/Geometry.cxx",
          "last - (IsUpperChild(lastChild) ? 0 : 1)", "last"),
    Fault("offset: the parent of a negative child", "src/array/Geometry.cxx",
          "child < 0 && IsUpperChild(child) ? 1 : 0", "child < 0 && IsUpperChild(child) ? 0 : 0"),

    # Limits of the non-oscillatory scheme.
    Fault("limit: without a lower end", STAGES + "Rows-inl.h",
          "return OrderedMin(bound, OrderedMax(Neg(bound), difference));", "return OrderedMin(bound, difference);"),
    Fault("limit: the variation of y forgets the row before", STAGES + "InPlaneDifferences-inl.h",
          "Store(ToOrderedBits(AddPrevious(partY, previousY + x)), yVariation + x);",
          "Store(ToOrderedBits(partY), yVariation + x);"),
    Fault("limit: the window along z forgets its oldest plane", STAGES + "SweepDifferences-inl.h",
          "MinNonNegative(MinNonNegative(middlePair, Load(oldestLater)), newestPair)",
          "MinNonNegative(middlePair, newestPair)"),
    Fault("limit: an infinite tension", "src/kernel/Kernel.cxx",
          "std::numeric_limits<TReal>::max() / factor", "std::numeric_limits<TReal>::infinity()"),
    Fault("limit: four times the largest tension overflows", "src/kernel/Kernel.cxx",
          "scheme.Limited == Correction::TowardsLinear ? 4 : 1", "scheme.Limited == Correction::TowardsLinear ? 1 : 1"),
    Fault("limit: a tension of 1 is taken", "src/kernel/Scheme.cxx", "tension > 1)", "tension >= 1)"),

    # The local range, and the restored scheme.
    Fault("range: a neighbour along x is left out", STAGES + "LocalRange-inl.h",
          "OrderedMax(OrderedMax(greatestOf(x, -1), greatestOf(x, 0)), greatestOf(x, 1))",
          "OrderedMax(greatestOf(x, -1), greatestOf(x, 0))"),
    Fault("restored: the weight of L", STAGES + "Sharpening-inl.h", "Broadcast<T>(-15.0 / 16)", "Broadcast<T>(-14.0 / 16)"),
    Fault("restored: the weight of L L", STAGES + "Sharpening-inl.h", "Broadcast<T>(-9.0 / 64)", "Broadcast<T>(-8.0 / 64)"),
    Fault("restored: the tension counts twice instead of four times", STAGES + "Restoration-inl.h",
          "Broadcast<T>(4 * tension)", "Broadcast<T>(2 * tension)"),
    Fault("restored: the quotient upside down", STAGES + "Restoration-inl.h",
          "Mul(least, Div(least, greatest))", "Mul(least, Div(greatest, least))"),
    Fault("restored: any limit where nothing varies", STAGES + "Restoration-inl.h",
          "ZeroUnlessDivisible(Mul(factor, Mul(least, Div(least, greatest))), greatest)",
          "Mul(factor, Mul(least, Div(least, greatest)))"),
    Fault("restored: the variation leaves z out", STAGES + "Restoration-inl.h", "if (VX && hasZ)", "if (VX && !hasZ)"),
    Fault("restored: E is not bounded", "src/kernel/RestoredSweep-inl.h",
          "IfFinite(smooth, OrderedMin(OrderedMax(smooth, Load(Low + x)), Load(High + x)))", "smooth"),

    # Elements.
    Fault("rounding: ties away from zero", VECTORS + "RoundToElement.h",
          "rest > 0.5 || (rest == 0.5 && truncated % 2 != 0)", "rest > 0.5 || rest == 0.5"),
    Fault("rounding: to halves, in plain vectors", VECTORS + "ConversionsPortable.h", "integersOnly = 12582912.0f",
          "integersOnly = 6291456.0f"),
    Fault("rounding: the upper end in vector code", VECTORS + "ConversionsHighway-inl.h",
          "static_cast<float>(hwy::HighestValue<TElement>())", "static_cast<float>(hwy::HighestValue<TElement>() - 1)",
          "VectorTests"),
    Fault("rounding: NaN is no 0", VECTORS + "RoundToElement.h", "if (number != number)", "if (number == number + 1)"),
    Fault("rounding: the greatest number that fits", VECTORS + "RoundToElement.h",
          "static_cast<std::int64_t>(Limits::max()) ? Limits::max()",
          "static_cast<std::int64_t>(Limits::max()) ? static_cast<TElement>(Limits::max() - 1)"),
    Fault("rounding: a voxel is scaled twice", STAGES + "Masks-inl.h", "ScaleOfChildren = 256", "ScaleOfChildren = 512"),
    # Where there is the one register, C libraries but that of mingw-w64 set it, too.
    Fault("arithmetic: the caller's rounding mode", "src/array/DefaultFloatingPoint.cxx",
          "  _mm_setcsr(0x1F80);\n#endif\n  std::fegetenv(&m_Former);\n  std::fesetenv(FE_DFL_ENV);",
          "#endif\n  std::fegetenv(&m_Former);"),
    Fault("arithmetic: the caller's is lost", "src/array/DefaultFloatingPoint.cxx", "std::fesetenv(&m_Former);", ""),
    Fault("arithmetic: labels in the caller's", "src/array/LabelSubdivider.cxx",
          "const DefaultFloatingPoint environment;", ""),
    Fault("losses: the half beyond the greatest", "src/array/Losses.cxx",
          "static_cast<double>(Limits::max()) + 0.5", "static_cast<double>(Limits::max()) + 1.5"),

    # Tiles, boundaries, parts.
    Fault("tiling: the last tile of an axis is left out", "src/array/Tiling.cxx",
          "size / part + (size % part != 0 ? 1 : 0)", "size / part + (size < part ? 1 : 0)"),
    Fault("tiling: tiles overlap", "src/array/Tiling.cxx",
          "std::min(m_TileSize[axis], m_Parents[axis] - first)", "std::min(m_TileSize[axis] + 1, m_Parents[axis] - first)"),
    Fault("tiling: a kernel too large is kept for a smaller run", "src/array/ScratchPool.h",
          "Tension == other.Tension", "Tension <= other.Tension"),
    Fault("boundary: the mirror repeats no face", "src/array/Boundary.cxx",
          "% 2 == 0 ? remainder : size - 1 - remainder", "% 2 == 0 ? remainder : size - remainder - (remainder > 0)"),
    Fault("boundary: periodic without the wrap below 0", "src/array/Boundary.cxx",
          "index % size + (index % size < 0 ? size : 0)", "index % size + (index % size < 0 ? size - 1 : 0)"),
    Fault("boundary: a request across one mirror is too small", "src/array/Boundary.cxx",
          "? 0 : size - 1;", "? 1 : size - 1;"),
    Fault("boundary: the constant of another component", "src/array/RowReader.cxx",
          "m_Index[0] - m_Plan.FirstConstant", "0 * (m_Index[0] - m_Plan.FirstConstant)"),
    Fault("region: the first child of a part is the lower one", "src/array/RunPlan.cxx",
          "outputs.First - Children * parents.First : 0", "0 * outputs.First : 0"),
    Fault("region: skipped children of a row", "src/array/RowWriter.cxx",
          "m_Buffer.data() + m_Skipped * m_Bytes", "m_Buffer.data()"),
    Fault("region: order of memory by the output", "src/array/RunPlan.cxx",
          "OrderAxes(input.Axes, ", "OrderAxes(output.Axes, "),

    # Labels.
    Fault("labels: a tie goes to the later label", "src/array/LabelElection.cxx",
          "vote > most[x] || (vote == most[x] && parents[x] == m_Label)", "vote >= most[x]"),
    Fault("labels: a tie leaves the parent's", "src/array/LabelElection.cxx",
          "vote > most[x] || (vote == most[x] && parents[x] == m_Label)", "vote > most[x]"),
    Fault("labels: of two, the other one wins a tie", "src/array/LabelElection.cxx",
          "vote < 0.5 ? other : winners[x]", "vote <= 0.5 ? other : winners[x]"),
    Fault("labels: the vote reaches no neighbour", "src/array/LabelElection.cxx",
          "m_Children[axis] > 1 ? reach : 0", "m_Children[axis] > 1 ? reach - 1 : 0"),
    Fault("labels: a voxel beside another label is not mixed", "src/array/LabelBlock.cxx",
          "(label[i + stride] != label[i])", "0"),
    Fault("labels: what does not fit is cut off", "src/array/LabelWriter.cxx",
          "static_cast<std::uint64_t>(label) <= static_cast<std::uint64_t>(std::numeric_limits<TOut>::max())", "true"),

    # The filter.
    Fault("filter: the first child's place", SCHEME, "FirstChildPosition = -0.25", "FirstChildPosition = 0.25", "FilterTests"),
    Fault("filter: the spacing stays", "include/itkSubdivisionImageFilterBase.hxx",
          "spacing[axis] /= Subdivision::Children;", "spacing[axis] /= 1;", "FilterTests"),
    Fault("filter: the axes of the view", "include/itkSubdivisionImageView.h",
          "image->GetOffsetTable()[axis] * components", "image->GetOffsetTable()[axis]", "FilterTests"),
    Fault("filter: a part is read from the image's start", "include/itkSubdivisionImageView.h",
          "(region.GetIndex(axis) - image->GetBufferedRegion().GetIndex(axis)) * stride",
          "(region.GetIndex(axis) - image->GetLargestPossibleRegion().GetIndex(axis)) * stride", "FilterTests"),
    Fault("filter: the boundary condition is forgotten", "include/itkSubdivisionImageFilterBase.hxx",
          "  std::unique_ptr<Subdivision::TileRun> run;",
          "  options.Boundary = Subdivision::Boundary::Nearest();\n  std::unique_ptr<Subdivision::TileRun> run;",
          "FilterTests"),
    Fault("filter: the request forgets the boundary condition", "include/itkSubdivisionImageFilterBase.hxx",
          "  return Detail::ToRegion<Dimension>(Subdivision::Subdivider::GetInputRequest(",
          "  options.Boundary = Subdivision::Boundary::Nearest();\n"
          "  return Detail::ToRegion<Dimension>(Subdivision::Subdivider::GetInputRequest(",
          "FilterTests"),
]
