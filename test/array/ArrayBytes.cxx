// SPDX-License-Identifier: Apache-2.0
// Whether the array layer's output has the bytes that it has on other machines: one run a line, of every scheme, choice
// of axes and boundary, and of label maps, between the types of elements, with every target of this processor. A line
// has two hashes: of the portable target and all others that round each product, and of those that add to a product
// before they round.
//   ArrayBytes HASHES           compares with a file of such lines; names each line that differs
//   ArrayBytes --print FUSING   writes the lines, with the second hash by that target: AVX2, NEON, SVE

#include "common/GreyValues.h"
#include "HashedArray.h"

#include "NonOscillatorySubdivision/LabelSubdivider.h"
#include "NonOscillatorySubdivision/RunTiles.h"
#include "NonOscillatorySubdivision/Subdivider.h"

#include <cstdint>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace itk::Subdivision;

using Sizes3 = std::vector<std::uint64_t>;
using Lines = std::vector<std::string>;

/** Bodies of a few voxels of four labels. */
std::uint64_t
GetLabel(const std::uint64_t position)
{
  return Scramble(position / 5) % 4 * 30;
}

class SilentMonitor final : public TileMonitor
{
public:
  void
  Completed(std::size_t) override
  {}
  bool
  IsStopped() const override
  {
    return false;
  }
};

/** The runs of one target, line by line. */
class Printer
{
public:
  explicit Printer(const Target & target)
    : m_Target(&target)
  {}

  Lines
  Print()
  {
    using Type = ElementType;
    const std::pair<Type, Type> conversions[] = { { Type::UInt8, Type::UInt8 },   { Type::Int8, Type::Int8 },
                                                  { Type::UInt16, Type::UInt16 }, { Type::Int16, Type::Int16 },
                                                  { Type::UInt32, Type::UInt32 }, { Type::Int32, Type::Int32 },
                                                  { Type::UInt64, Type::UInt64 }, { Type::Int64, Type::Int64 },
                                                  { Type::Float, Type::Float },   { Type::Double, Type::Double },
                                                  { Type::UInt16, Type::Float },  { Type::Float, Type::UInt8 },
                                                  { Type::Double, Type::UInt8 },  { Type::UInt8, Type::Double } };
    for (const auto & [from, to] : conversions)
    {
      for (unsigned int axes = 1; axes < 8; ++axes)
      {
        this->PrintGreyValues(from, to, { 11, 6, 5 }, axes);
      }
      this->PrintGreyValues(from, to, { 67, 13, 9 }, 7);
    }
    for (const Type type : { Type::Float, Type::Double })
    {
      // Several tiles; a single voxel; components of pixels, which are the first axis.
      this->PrintGreyValues(type, type, { 523, 9, 7 }, 7);
      this->PrintGreyValues(type, type, { 1, 1, 1 }, 7);
      this->PrintGreyValues(type, type, { 3, 19, 17 }, 6);
    }
    for (const Type type : { Type::UInt8, Type::Int16, Type::UInt32, Type::Int64 })
    {
      for (unsigned int axes = 1; axes < 8; ++axes)
      {
        this->PrintLabels(type, { 17, 9, 8 }, axes);
      }
    }
    return std::move(m_Lines);
  }

private:
  static constexpr std::uint64_t EmptyHash = 14695981039346656037u;

  static Box
  MakeBox(const Sizes3 & size)
  {
    Box box;
    for (std::size_t axis = 0; axis < size.size(); ++axis)
    {
      box.push_back({ 3 - 4 * static_cast<std::int64_t>(axis), size[axis] });
    }
    return box;
  }

  static Flags
  MakeFlags(const unsigned int axes)
  {
    return { (axes & 1) != 0, (axes & 2) != 0, (axes & 4) != 0 };
  }

  void
  AddLine(const std::string & types,
          const Scheme &      scheme,
          const Sizes3 &      size,
          const unsigned int  axes,
          const std::uint64_t hash)
  {
    std::ostringstream line;
    line << types << ' ' << scheme.Name << ' ' << (axes & 1 ? "x" : "") << (axes & 2 ? "y" : "")
         << (axes & 4 ? "z" : "") << ' ' << size[0] << 'x' << size[1] << 'x' << size[2] << ' ' << std::hex
         << std::setw(16) << std::setfill('0') << hash;
    m_Lines.push_back(line.str());
  }

  /** A line holds for all boundaries, one after the other. */
  void
  PrintGreyValues(const ElementType from, const ElementType to, const Sizes3 & size, const unsigned int axes)
  {
    const Box   whole = MakeBox(size);
    HashedArray input(from, whole);
    if (IsInteger(from))
    {
      // Every bit of wide integers.
      const int width = static_cast<int>(8 * SizeOf(from));
      input.Fill([=](const std::uint64_t i) {
        return width > 16 ? GetGreyValue(i) << (width - 16) | Scramble(i) >> (80 - width)
                          : GetGreyValue(i) >> (16 - width);
      });
    }
    else
    {
      input.Fill([](const std::uint64_t i) { return static_cast<double>(GetGreyValue(i)) / 1000.0 - 20.0; });
    }
    for (const Scheme & scheme : Schemes)
    {
      std::uint64_t hash = EmptyHash;
      for (const Boundary & boundary :
           { Boundary::Nearest(), Boundary::Mirror(), Boundary::Periodic(), Boundary::Constant({ 17.0 }) })
      {
        Options options;
        options.Scheme = &scheme;
        options.Tension = boundary.MapsIndices() ? 2.0 : 1.25;
        options.SubdividedAxes = MakeFlags(axes);
        options.Boundary = boundary;
        options.Target = m_Target;
        const Box     box = Subdivider::GetWholeOutput(whole, options.SubdividedAxes);
        HashedArray   output(to, box);
        Workspace     workspace;
        SilentMonitor monitor;
        Subdivider    run(input.ConstView(), whole, output.View(), options, 2, workspace);
        RunTiles(run, 2, monitor);
        hash = output.Hash(hash);
      }
      this->AddLine(std::string(GetName(from)) + '-' + GetName(to), scheme, size, axes, hash);
    }
  }

  void
  PrintLabels(const ElementType type, const Sizes3 & size, const unsigned int axes)
  {
    const Box   whole = MakeBox(size);
    HashedArray input(type, whole);
    input.Fill(GetLabel);
    for (const char * const name : { "restored", "bspline", "linear" })
    {
      Options options = LabelSubdivider::GetDefaultOptions();
      options.Scheme = &FindScheme(name);
      options.SubdividedAxes = MakeFlags(axes);
      options.Target = m_Target;
      HashedArray     output(type, Subdivider::GetWholeOutput(whole, options.SubdividedAxes));
      SilentMonitor   monitor;
      LabelSubdivider run(input.ConstView(), whole, output.View(), options);
      RunTiles(run, 2, monitor);
      this->AddLine(std::string("labels-") + GetName(type), *options.Scheme, size, axes, output.Hash(EmptyHash));
    }
  }

  const Target * m_Target;
  Lines          m_Lines;
};

/** The runs of a target, without and with their hashes. */
std::pair<Lines, Lines>
Compute(const std::string & target)
{
  Lines runs = Printer(Target::Named(target)).Print();
  Lines hashes;
  for (std::string & run : runs)
  {
    const std::size_t space = run.rfind(' ');
    hashes.push_back(run.substr(space + 1));
    run.resize(space);
  }
  return { runs, hashes };
}

void
Print(const std::string & fusingTarget)
{
  const auto [runs, rounded] = Compute("portable");
  const auto [sameRuns, fused] = Compute(fusingTarget);
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    std::cout << runs[i] << ' ' << rounded[i] << ' ' << fused[i] << '\n';
  }
}

/** What a file of hashes expects. */
struct Expectation
{
  Lines Runs;
  Lines Rounded;
  Lines Fused;

  explicit Expectation(const std::string & file)
  {
    std::ifstream text(file);
    std::string   words[6];
    while (text >> words[0] >> words[1] >> words[2] >> words[3] >> words[4] >> words[5])
    {
      Runs.push_back(words[0] + ' ' + words[1] + ' ' + words[2] + ' ' + words[3]);
      Rounded.push_back(words[4]);
      Fused.push_back(words[5]);
    }
  }
};

/** Whether a target has one or the other of the expected hashes throughout, and the portable one the first. */
bool
Compare(const std::string & target, const Expectation & expected)
{
  const auto [runs, hashes] = Compute(target);
  std::cout << target << ": ";
  if (runs != expected.Runs)
  {
    std::cout << "its " << runs.size() << " runs are not the " << expected.Runs.size() << " of the file\n";
    return false;
  }
  const bool isRounded = hashes == expected.Rounded;
  if (isRounded || (hashes == expected.Fused && target != "portable"))
  {
    std::cout << runs.size() << " runs with the bytes of " << (isRounded ? "rounded products\n" : "fused additions\n");
    return true;
  }
  const Lines & closest = target == "portable" ? expected.Rounded : expected.Fused;
  std::size_t   differ = 0;
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    if (hashes[i] != closest[i])
    {
      ++differ;
      std::cout << "\n  " << runs[i] << ": " << hashes[i] << " where " << closest[i] << " is expected";
    }
  }
  std::cout << '\n' << target << ": " << differ << " of " << runs.size() << " runs with other bytes\n";
  return false;
}

} // namespace

int
main(const int argc, char ** const argv)
{
  const std::string first = argc > 1 ? argv[1] : "";
  if (argc != (first == "--print" ? 3 : 2))
  {
    std::cerr << "usage: ArrayBytes HASHES | --print FUSING\n";
    return 2;
  }
  try
  {
    if (first == "--print")
    {
      Print(argv[2]);
      return 0;
    }
    const Expectation expected(first);
    bool              areSame = true;
    for (const std::string & target : Target::GetNames())
    {
      areSame = Compare(target, expected) && areSame;
    }
    return areSame ? 0 : 1;
  }
  catch (const std::exception & error)
  {
    std::cerr << "ArrayBytes: " << error.what() << '\n';
    return 1;
  }
}
