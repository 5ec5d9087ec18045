// SPDX-License-Identifier: Apache-2.0
#include "headers/MetaHeader.h"
#include "headers/DataFiles.h"
#include "headers/MetaFields.h"
#include "system/files/InputFile.h"
#include "text/HeaderText.h"
#include "volumes/DescriptionCheck.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace
{
using itk::Subdivision::ElementType;

// MET_LONG and MET_ULONG have four or eight bytes, depending on who wrote them: see LocateLongs().
constexpr std::array<std::pair<const char *, ElementType>, 10> Types = { {
  { "MET_UCHAR", ElementType::UInt8 },
  { "MET_CHAR", ElementType::Int8 },
  { "MET_USHORT", ElementType::UInt16 },
  { "MET_SHORT", ElementType::Int16 },
  { "MET_UINT", ElementType::UInt32 },
  { "MET_INT", ElementType::Int32 },
  { "MET_ULONG_LONG", ElementType::UInt64 },
  { "MET_LONG_LONG", ElementType::Int64 },
  { "MET_FLOAT", ElementType::Float },
  { "MET_DOUBLE", ElementType::Double },
} };

ElementType
GetType(const std::string & path, const std::string & name)
{
  for (const auto & [known, type] : Types)
  {
    if (name == known)
    {
      return type;
    }
  }
  FailToRead(path, "voxels of the type '" + name + "' are not supported");
}

ImageGrid
GetGrid(const std::string & path, const MetaFields & fields)
{
  const std::int64_t axes = ParseInteger(path, "NDims", fields.Get("NDims"));
  if (axes < 1 || axes > 4)
  {
    FailToRead(path, "it has " + std::to_string(axes) + " axes; up to 4 are supported");
  }
  const auto count = static_cast<std::size_t>(axes);
  ImageGrid  grid;
  grid.Size = ParseSizes(path, "DimSize", fields.Get("DimSize"), count);
  const auto spacing = fields.Find({ "ElementSpacing" });
  const auto size = fields.Find({ "ElementSize" });
  grid.Spacing = spacing ? ParseReals(path, "ElementSpacing", *spacing, count)
                 : size  ? ParseReals(path, "ElementSize", *size, count)
                         : std::vector<double>(count, 1.0);
  const auto origin = fields.Find({ "Offset", "Position", "Origin" });
  grid.Origin = origin ? ParseReals(path, "Offset", *origin, count) : std::vector<double>(count, 0.0);
  const auto          matrix = fields.Find({ "TransformMatrix", "Rotation", "Orientation" });
  std::vector<double> numbers(count * count, 0.0);
  for (std::size_t axis = 0; axis < count; ++axis)
  {
    numbers[axis * count + axis] = 1.0;
  }
  numbers = matrix ? ParseReals(path, "TransformMatrix", *matrix, count * count) : numbers;
  for (std::size_t axis = 0; axis < count; ++axis)
  {
    const auto first = numbers.begin() + static_cast<std::ptrdiff_t>(axis * count);
    grid.Directions.emplace_back(first, first + axes);
  }
  return grid;
}

/** The names after the field, one a line. */
std::vector<std::string>
ReadNames(const InputFile & file, std::uint64_t start, std::uint64_t count)
{
  std::vector<std::string> names;
  const std::string        text = file.ReadTextAt(start, 1 << 26) + "\n";
  for (std::size_t first = 0, end = 0; (end = text.find('\n', first)) != std::string::npos; first = end + 1)
  {
    const std::string name = Trim(text.substr(first, end - first));
    if (!name.empty())
    {
      names.push_back(name);
    }
  }
  if (names.size() != count)
  {
    FailToRead(file.GetPath(),
               "its header lists " + std::to_string(names.size()) + " data files instead of " + std::to_string(count));
  }
  return names;
}

/** The number of files that hold the image if each has only so many of its axes. */
std::uint64_t
CountFiles(const std::string & path, const ImageGrid & grid, std::int64_t axesOfFile)
{
  const auto axes = static_cast<std::int64_t>(grid.Size.size());
  if (axesOfFile < 1 || axesOfFile > axes)
  {
    FailToRead(path, "its data files cannot have " + std::to_string(axesOfFile) + " axes");
  }
  std::uint64_t count = 1;
  for (std::int64_t axis = axesOfFile; axis < axes; ++axis)
  {
    count *= grid.Size[static_cast<std::size_t>(axis)];
  }
  return count;
}

std::vector<std::string>
FindDataFiles(const InputFile & file, const MetaFields & fields, const ImageGrid & grid)
{
  const std::string &      path = file.GetPath();
  const std::string        value = fields.Get("ElementDataFile");
  std::vector<std::string> words = SplitWords(value);
  if (words.empty())
  {
    FailToRead(path, "its header names no data file");
  }
  const auto axes = static_cast<std::int64_t>(grid.Size.size());
  if (words[0] == "LIST")
  {
    std::string axesOfFile = words.size() > 1 ? words[1] : std::to_string(std::max<std::int64_t>(axes - 1, 1));
    if (ToLower(axesOfFile.substr(axesOfFile.size() - 1)) == "d")
    {
      axesOfFile.pop_back();
    }
    return ReadNames(file, fields.End, CountFiles(path, grid, ParseInteger(path, "ElementDataFile", axesOfFile)));
  }
  if (words.size() >= 3 && words[0].find('%') != std::string::npos)
  {
    const std::uint64_t count = CountFiles(path, grid, std::max<std::int64_t>(axes - 1, 1));
    auto                names = ExpandPattern(path,
                               words[0],
                               ParseInteger(path, "ElementDataFile", words[1]),
                               ParseInteger(path, "ElementDataFile", words[2]),
                               words.size() > 3 ? ParseInteger(path, "ElementDataFile", words[3]) : 1);
    if (names.size() != count)
    {
      FailToRead(
        path, "its header names " + std::to_string(names.size()) + " data files instead of " + std::to_string(count));
    }
    return names;
  }
  return { value };
}

/** LocateData() for integers that have eight bytes, as the layout's type, or four: the length of the data tells. */
void
LocateLongs(const std::string & path, DataFiles files, const StreamMeasure measure, PlainLayout & layout)
{
  ElementType &     type = layout.Description.Component;
  const ElementType four = type == ElementType::UInt64 ? ElementType::UInt32 : ElementType::Int32;
  if (layout.Encoding == PlainEncoding::Raw)
  {
    PlainLayout other = layout;
    other.Description.Component = four;
    files.ByteSkip = std::max<std::int64_t>(files.ByteSkip, 0); // the voxels cannot be told from what is to be skipped
    try
    {
      LocateData(path, files, other);
      layout = other;
      return;
    }
    catch (const std::runtime_error &)
    {
      LocateData(path, files, layout);
      return;
    }
  }
  LocateData(path, files, layout);
  if (layout.Encoding == PlainEncoding::Compressed)
  {
    const std::uint64_t count = layout.Description.GetNumberOfVoxels() * layout.Description.NumberOfComponents;
    const std::uint64_t bytes = measure == nullptr ? 0 : measure(layout.Sections.front());
    if (bytes != 4 * count && bytes != 8 * count)
    {
      FailToRead(layout.Sections.front().Path,
                 "its compressed data holds " + std::to_string(bytes) + " bytes, neither four nor eight for each of " +
                   std::to_string(count) + " numbers of the type MET_LONG or MET_ULONG");
    }
    type = bytes == 4 * count ? four : type;
  }
}

VoxelKind
GetKind(unsigned int components)
{
  return components == 1 ? VoxelKind::Scalar : VoxelKind::Vector;
}
} // namespace

PlainLayout
ReadMetaHeader(const std::string & path, const StreamMeasure measure)
{
  const InputFile  file(path);
  const MetaFields fields(file);
  if (ToLower(fields.Find({ "ObjectType" }).value_or("Image")) != "image")
  {
    FailToRead(path, "it is a MetaIO file, but of no image");
  }
  PlainLayout        layout;
  ImageDescription & description = layout.Description;
  description.Format = "MetaImage";
  description.Grid = GetGrid(path, fields);
  const std::string  channels = fields.Find({ "ElementNumberOfChannels" }).value_or("1");
  const std::int64_t components = ParseInteger(path, "ElementNumberOfChannels", channels);
  if (components < 1 || components > 1000000)
  {
    FailToRead(path, "its voxels have " + channels + " components");
  }
  description.NumberOfComponents = static_cast<unsigned int>(components);
  description.Kind = GetKind(description.NumberOfComponents);
  const std::string type = fields.Get("ElementType");
  const bool        isLong = type == "MET_LONG" || type == "MET_ULONG";
  description.Component = GetType(path, isLong ? type + "_LONG" : type);
  CheckDescription(path, description);
  for (const auto & [key, value] : fields.GetAll())
  {
    if (!IsMetaField(key) || key == "DistanceUnits" || key == "Modality" || key == "Comment" || key == "Name")
    {
      description.Metadata.emplace(key, value);
    }
  }

  const bool isText = !fields.GetFlag({ "BinaryData" }, true);
  const bool isCompressed = fields.GetFlag({ "CompressedData" }, false);
  if (isText && isCompressed)
  {
    FailToRead(path, "its header says that its voxels are compressed text, which is not supported");
  }
  layout.Encoding = isText ? PlainEncoding::Text : isCompressed ? PlainEncoding::Compressed : PlainEncoding::Raw;
  layout.IsBigEndian = fields.GetFlag({ "BinaryDataByteOrderMSB", "ElementByteOrderMSB" }, false);
  DataFiles files;
  files.HeaderEnd = fields.End;
  files.ByteSkip = ParseInteger(path, "HeaderSize", fields.Find({ "HeaderSize" }).value_or("0"));
  files.ByteSkip = isCompressed ? 0 : std::max<std::int64_t>(files.ByteSkip, -1);
  const std::int64_t compressed =
    ParseInteger(path, "CompressedDataSize", fields.Find({ "CompressedDataSize" }).value_or("0"));
  files.CompressedSize = static_cast<std::uint64_t>(std::max<std::int64_t>(compressed, 0));
  if (ToLower(fields.Get("ElementDataFile")) != "local")
  {
    files.Names = FindDataFiles(file, fields, description.Grid);
  }
  if (files.Names.size() > 1 && isCompressed)
  {
    FailToRead(
      path, "its voxels are compressed in " + std::to_string(files.Names.size()) + " files, of which one is supported");
  }
  isLong ? LocateLongs(path, files, measure, layout) : LocateData(path, files, layout);
  return layout;
}

namespace
{
constexpr std::size_t SizeFieldDigits = 20;
const char * const    SizeField = "CompressedDataSize = ";

/** Where each axis starts, of right or left, anterior or posterior, inferior or superior. */
std::string
GetAnatomicalOrientation(const ImageGrid & grid)
{
  std::string letters;
  for (const std::vector<double> & direction : grid.Directions)
  {
    const auto largest = std::max_element(
      direction.begin(), direction.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    letters += "RAILPS"[largest - direction.begin() + (*largest < 0.0 ? 3 : 0)];
  }
  return letters;
}
} // namespace

std::string
ComposeMetaHeader(const ImageDescription & description,
                  const OutputMetadata &   metadata,
                  const std::string &      dataFile,
                  bool                     isCompressed)
{
  const ImageGrid &   grid = description.Grid;
  std::vector<double> matrix;
  for (const std::vector<double> & direction : grid.Directions)
  {
    matrix.insert(matrix.end(), direction.begin(), direction.end());
  }
  const auto type =
    std::find_if(Types.begin(), Types.end(), [&](const auto & entry) { return entry.second == description.Component; });

  std::string header =
    "ObjectType = Image\nNDims = " + std::to_string(grid.Size.size()) +
    "\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = " + (isCompressed ? "True\n" : "False\n");
  header += isCompressed ? SizeField + std::string(SizeFieldDigits, ' ') + "\n" : "";
  header += "TransformMatrix = " + JoinReals(matrix) + "\nOffset = " + JoinReals(grid.Origin) +
            "\nCenterOfRotation = " + JoinReals(std::vector<double>(grid.Size.size(), 0.0)) + "\n";
  header += grid.Size.size() == 3 ? "AnatomicalOrientation = " + GetAnatomicalOrientation(grid) + "\n" : "";
  header += "ElementSpacing = " + JoinReals(grid.Spacing) + "\nDimSize = " + JoinSizes(grid.Size) + "\n";
  for (const auto * const entries : { &metadata.Fields, &metadata.Keys })
  {
    for (const auto & [key, value] : *entries)
    {
      header += key + " = " + value + "\n";
    }
  }
  if (description.NumberOfComponents > 1)
  {
    header += "ElementNumberOfChannels = " + std::to_string(description.NumberOfComponents) + "\n";
  }
  return header + "ElementType = " + type->first + "\nElementDataFile = " + dataFile + "\n";
}

void
FillInCompressedSize(std::string & header, std::uint64_t size)
{
  const std::string digits = std::to_string(size);
  header.replace(header.find(SizeField) + std::string(SizeField).size(), digits.size(), digits);
}
