// SPDX-License-Identifier: Apache-2.0
#include "headers/NrrdHeader.h"
#include "text/HeaderText.h"

namespace
{
using itk::Subdivision::ElementType;

const char *
GetTypeName(ElementType type)
{
  static constexpr const char * names[] = { "uchar", "signed char", "ushort",   "short", "uint",
                                            "int",   "ulonglong",   "longlong", "float", "double" };
  return names[static_cast<std::size_t>(type)];
}

/** NRRD has kinds for a number of components each; all others are vectors. */
const char *
GetKindName(const ImageDescription & description)
{
  struct Kind
  {
    VoxelKind    Meaning;
    unsigned int Components;
    const char * Name;
  };
  static constexpr Kind kinds[] = { { VoxelKind::Rgb, 3, "RGB-color" },
                                    { VoxelKind::Rgba, 4, "RGBA-color" },
                                    { VoxelKind::Complex, 2, "complex" },
                                    { VoxelKind::SymmetricTensor, 6, "3D-symmetric-matrix" } };
  for (const Kind & kind : kinds)
  {
    if (kind.Meaning == description.Kind && kind.Components == description.NumberOfComponents)
    {
      return kind.Name;
    }
  }
  return "vector";
}

std::string
FormatVector(const std::vector<double> & values, double scale)
{
  std::string text;
  for (const double value : values)
  {
    text += (text.empty() ? "(" : ",") + FormatReal(value * scale);
  }
  return text + ")";
}

/** Kinds, sizes and directions, with an axis of components before the others if there are several. */
std::string
ComposeAxes(const ImageDescription & description)
{
  const ImageGrid & grid = description.Grid;
  const bool        hasComponents = description.NumberOfComponents > 1;
  std::string       sizes = hasComponents ? " " + std::to_string(description.NumberOfComponents) : "";
  std::string       directions = hasComponents ? " none" : "";
  std::string       kinds = hasComponents ? std::string(" ") + GetKindName(description) : "";
  for (std::size_t axis = 0; axis < grid.Size.size(); ++axis)
  {
    sizes += " " + std::to_string(grid.Size[axis]);
    directions += " " + FormatVector(grid.Directions[axis], grid.Spacing[axis]);
    kinds += " domain";
  }
  return "sizes:" + sizes + "\nspace directions:" + directions + "\nkinds:" + kinds + "\n";
}

/** NRRD's own way to put characters that end a line into a value. */
std::string
Escape(const std::string & value)
{
  std::string text;
  for (const char c : value)
  {
    text += c == '\\' ? "\\\\" : c == '\n' ? "\\n" : std::string(1, c);
  }
  return text;
}
} // namespace

std::string
ComposeNrrdHeader(const ImageDescription & description,
                  const OutputMetadata &   metadata,
                  const std::string &      dataFile,
                  bool                     isCompressed)
{
  const ImageGrid & grid = description.Grid;
  const std::size_t axes = grid.Size.size();
  const auto        space = metadata.Fields.find("space");
  // What refers to the space comes after it.
  std::string fields = space != metadata.Fields.end() ? "space: " + space->second + "\n"
                       : axes == 3                    ? "space: left-posterior-superior\n"
                                                      : "space dimension: " + std::to_string(axes) + "\n";
  for (const auto & [name, value] : metadata.Fields)
  {
    fields += name != "space" ? name + ": " + value + "\n" : "";
  }
  std::string keys;
  for (const auto & [key, value] : metadata.Keys)
  {
    keys += key + ":=" + Escape(value) + "\n";
  }
  return std::string("NRRD0005\n# Complete NRRD file format specification at:\n") +
         "# http://teem.sourceforge.net/nrrd/format.html\ntype: " + GetTypeName(description.Component) +
         "\ndimension: " + std::to_string(axes + (description.NumberOfComponents > 1 ? 1 : 0)) + "\n" + fields +
         ComposeAxes(description) + "endian: little\nencoding: " + (isCompressed ? "gzip" : "raw") +
         "\nspace origin: " + FormatVector(grid.Origin, 1.0) + "\n" +
         (dataFile.empty() ? "" : "data file: " + dataFile + "\n") + keys + "\n";
}
