// SPDX-License-Identifier: Apache-2.0
// The module nonoscillatory_subdivision._core: the array layer for NumPy arrays, one level at a time. Checks of what a
// user passes, levels and regions are Python's (nonoscillatory_subdivision/_run.py).

#include "PythonMonitor.h"
#include "WorkspaceLoan.h"

#include "NonOscillatorySubdivision/LabelSubdivider.h"
#include "NonOscillatorySubdivision/RunTiles.h"
#include "NonOscillatorySubdivision/Scheme.h"
#include "NonOscillatorySubdivision/Subdivider.h"
#include "NonOscillatorySubdivision/Target.h"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace nb = nanobind;
using namespace nb::literals;
using namespace itk::Subdivision;

namespace
{

// Indices along NumPy's axes, the slowest first. Those of the array layer are the same ones reversed.
using Indices = std::vector<std::int64_t>;
using InputArray = nb::ndarray<nb::ro, nb::device::cpu>;
using OutputArray = nb::ndarray<nb::device::cpu>;

ElementType
ToElementType(const nb::dlpack::dtype & type)
{
  const bool isFloat = type.code == static_cast<std::uint8_t>(nb::dlpack::dtype_code::Float);
  const bool isSigned = type.code == static_cast<std::uint8_t>(nb::dlpack::dtype_code::Int);
  for (int value = 0; value <= static_cast<int>(ElementType::Double); ++value)
  {
    const auto element = static_cast<ElementType>(value);
    const bool isSameKind = WithElementType(element, [&](auto tag) {
      using Type = typename decltype(tag)::Type;
      return std::is_floating_point<Type>::value == isFloat && (isFloat || std::is_signed<Type>::value == isSigned);
    });
    if (isSameKind && SizeOf(element) * 8 == type.bits)
    {
      return element;
    }
  }
  throw std::invalid_argument("no such element type");
}

Box
ToBox(const Indices & first, const Indices & size)
{
  Box box;
  for (std::size_t axis = first.size(); axis-- > 0;)
  {
    box.push_back({ first[axis], static_cast<std::uint64_t>(size.at(axis)) });
  }
  return box;
}

template <typename TView, typename TArray>
TView
ToView(const TArray & array, const Indices & first)
{
  TView view{ array.data(), ToElementType(array.dtype()), {} };
  for (std::size_t axis = array.ndim(); axis-- > 0;)
  {
    view.Axes.push_back({ first.at(axis), array.shape(axis), static_cast<std::ptrdiff_t>(array.stride(axis)) });
  }
  return view;
}

Boundary
MakeBoundary(const std::string & name, const double constant)
{
  if (name == "constant")
  {
    return Boundary::Constant({ constant });
  }
  return name == "mirror" ? Boundary::Mirror() : name == "periodic" ? Boundary::Periodic() : Boundary::Nearest();
}

Options
MakeOptions(const std::string & scheme, double tension, Flags axes, const std::string & boundary, double constant)
{
  Options options;
  options.Scheme = &FindScheme(scheme);
  options.Tension = tension;
  std::reverse(axes.begin(), axes.end());
  options.SubdividedAxes = std::move(axes);
  options.Boundary = MakeBoundary(boundary, constant);
  CheckTension(*options.Scheme, tension);
  return options;
}

std::pair<Indices, Indices>
GetInputRequest(const Options & options, const Indices & first, const Indices & size, const Indices & whole)
{
  const Box request = Subdivider::GetInputRequest(ToBox(first, size), ToBox(Indices(whole.size(), 0), whole), options);
  std::pair<Indices, Indices> result;
  for (auto interval = request.rbegin(); interval != request.rend(); ++interval)
  {
    result.first.push_back(interval->First);
    result.second.push_back(static_cast<std::int64_t>(interval->Size));
  }
  return result;
}

/** Runs one level without the interpreter's lock. \c computeTiles is given the views, the whole and a monitor. */
template <typename TFunction>
void
RunLevel(const InputArray &  input,
         const Indices &     inputFirst,
         const Indices &     whole,
         const OutputArray & output,
         const Indices &     outputFirst,
         nb::object          progress,
         const double        begin,
         const double        end,
         TFunction           computeTiles)
{
  const auto                   inputView = ToView<ConstArrayView>(input, inputFirst);
  const auto                   outputView = ToView<ArrayView>(output, outputFirst);
  const Box                    wholeBox = ToBox(Indices(whole.size(), 0), whole);
  PythonMonitor                monitor(std::move(progress), begin, end, output.size());
  const nb::gil_scoped_release unlocked;
  computeTiles(inputView, wholeBox, outputView, monitor);
}

void
Subdivide(const Options &     options,
          const InputArray &  input,
          const Indices &     inputFirst,
          const Indices &     whole,
          const OutputArray & output,
          const Indices &     outputFirst,
          const unsigned int  threads,
          nb::object          progress,
          const double        begin,
          const double        end)
{
  const auto compute =
    [&](const ConstArrayView & from, const Box & wholeBox, const ArrayView & to, TileMonitor & monitor) {
      WorkspaceLoan workspace;
      Subdivider    run(from, wholeBox, to, options, threads, workspace.Get());
      RunTiles(run, threads, monitor);
    };
  RunLevel(input, inputFirst, whole, output, outputFirst, std::move(progress), begin, end, compute);
}

void
SubdivideLabels(const Options &     options,
                const InputArray &  input,
                const Indices &     inputFirst,
                const Indices &     whole,
                const OutputArray & output,
                const Indices &     outputFirst,
                const unsigned int  threads,
                nb::object          progress,
                const double        begin,
                const double        end)
{
  const auto compute =
    [&](const ConstArrayView & from, const Box & wholeBox, const ArrayView & to, TileMonitor & monitor) {
      LabelSubdivider run(from, wholeBox, to, options);
      RunTiles(run, threads, monitor);
    };
  RunLevel(input, inputFirst, whole, output, outputFirst, std::move(progress), begin, end, compute);
}

std::vector<std::string>
GetSchemeNames()
{
  std::vector<std::string> names;
  for (const Scheme & scheme : Schemes)
  {
    names.emplace_back(scheme.Name);
  }
  return names;
}

} // namespace

NB_MODULE(_core, module)
{
  module.attr("__version__") = NonOscillatorySubdivision_VERSION;
  module.def("schemes", &GetSchemeNames);
  module.def("targets", &Target::GetNames);
  module.def("radius", [](const std::string & scheme) { return FindScheme(scheme).Radius(); }, "scheme"_a);
  nb::class_<Options>(module, "Options")
    .def(
      "__init__",
      [](Options *           self,
         const std::string & scheme,
         double              tension,
         const Flags &       axes,
         const std::string & boundary,
         double              constant) { new (self) Options(MakeOptions(scheme, tension, axes, boundary, constant)); },
      "scheme"_a,
      "tension"_a,
      "axes"_a,
      "boundary"_a,
      "constant"_a)
    .def("input_request", &GetInputRequest, "first"_a, "size"_a, "whole"_a);
  const auto defineLevel = [&module](const char * name, auto function) {
    module.def(name,
               function,
               "options"_a,
               "input"_a,
               "input_first"_a,
               "whole"_a,
               "output"_a,
               "output_first"_a,
               "threads"_a,
               "progress"_a.none(),
               "begin"_a,
               "end"_a);
  };
  defineLevel("subdivide", &Subdivide);
  defineLevel("subdivide_labels", &SubdivideLabels);
}
