// SPDX-License-Identifier: Apache-2.0
#include "NrrdHeader.h"
#include "DataFiles.h"
#include "HeaderText.h"
#include "InputFile.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>

namespace
{
using itk::Subdivision::ElementType;

const std::map<std::string, ElementType> Types = {
  { "signed char", ElementType::Int8 },
  { "int8", ElementType::Int8 },
  { "int8_t", ElementType::Int8 },
  { "uchar", ElementType::UInt8 },
  { "unsigned char", ElementType::UInt8 },
  { "uint8", ElementType::UInt8 },
  { "uint8_t", ElementType::UInt8 },
  { "short", ElementType::Int16 },
  { "short int", ElementType::Int16 },
  { "signed short", ElementType::Int16 },
  { "signed short int", ElementType::Int16 },
  { "int16", ElementType::Int16 },
  { "int16_t", ElementType::Int16 },
  { "ushort", ElementType::UInt16 },
  { "unsigned short", ElementType::UInt16 },
  { "unsigned short int", ElementType::UInt16 },
  { "uint16", ElementType::UInt16 },
  { "uint16_t", ElementType::UInt16 },
  { "int", ElementType::Int32 },
  { "signed int", ElementType::Int32 },
  { "int32", ElementType::Int32 },
  { "int32_t", ElementType::Int32 },
  { "uint", ElementType::UInt32 },
  { "unsigned int", ElementType::UInt32 },
  { "uint32", ElementType::UInt32 },
  { "uint32_t", ElementType::UInt32 },
  { "longlong", ElementType::Int64 },
  { "long long", ElementType::Int64 },
  { "long long int", ElementType::Int64 },
  { "signed long long", ElementType::Int64 },
  { "signed long long int", ElementType::Int64 },
  { "int64", ElementType::Int64 },
  { "int64_t", ElementType::Int64 },
  { "ulonglong", ElementType::UInt64 },
  { "unsigned long long", ElementType::UInt64 },
  { "unsigned long long int", ElementType::UInt64 },
  { "uint64", ElementType::UInt64 },
  { "uint64_t", ElementType::UInt64 },
  { "float", ElementType::Float },
  { "double", ElementType::Double },
};

// Names as NormaliseName() makes them.
const std::set<std::string> Fields = {
  "content",
  "number",
  "type",
  "blocksize",
  "dimension",
  "space",
  "spacedimension",
  "sizes",
  "spacings",
  "thicknesses",
  "axismins",
  "axismaxs",
  "centers",
  "centerings",
  "labels",
  "units",
  "kinds",
  "min",
  "max",
  "oldmin",
  "oldmax",
  "datafile",
  "endian",
  "encoding",
  "lineskip",
  "byteskip",
  "keyvalue",
  "sampleunits",
  "spaceunits",
  "spaceorigin",
  "spacedirections",
  "measurementframe",
};

std::string
NormaliseName(const std::string & name)
{
  std::string normal = ToLower(name);
  normal.erase(std::remove(normal.begin(), normal.end(), ' '), normal.end());
  return normal;
}

/** A value as it was before a writer put the ends of its lines into one line. */
std::string
Unescape(const std::string & value)
{
  std::string text;
  for (std::size_t i = 0; i < value.size(); ++i)
  {
    const bool isEscaped = value[i] == '\\' && i + 1 < value.size() && (value[i + 1] == 'n' || value[i + 1] == '\\');
    i += isEscaped ? 1 : 0;
    text += isEscaped && value[i] == 'n' ? '\n' : value[i];
  }
  return text;
}

class NrrdFields
{
public:
  explicit NrrdFields(const InputFile & file)
    : m_Path(file.GetPath())
  {
    constexpr std::uint64_t longest = 1 << 24;
    const std::string       text = file.ReadTextAt(0, 1 << 16);
    if (!this->Parse(text, text.size() == file.GetSize()))
    {
      const std::string more = file.ReadTextAt(0, longest);
      if (!this->Parse(more, more.size() == file.GetSize()))
      {
        FailToRead(m_Path, "its header does not end with an empty line");
      }
    }
  }

  std::optional<std::string>
  Find(const std::string & name) const
  {
    const auto found = m_Values.find(name);
    return found == m_Values.end() ? std::nullopt : std::optional<std::string>(found->second);
  }

  std::string
  Get(const std::string & name) const
  {
    const auto value = this->Find(name);
    if (!value)
    {
      FailToRead(m_Path, "its header lacks the field '" + name + "'");
    }
    return *value;
  }

  std::uint64_t                      End = 0;     // where the data follow
  std::vector<std::string>           ListedNames; // after "data file: LIST"
  std::map<std::string, std::string> KeyValues;   // in the form key:=value

private:
  bool
  Parse(const std::string & text, bool isWholeFile)
  {
    m_Values.clear();
    KeyValues.clear();
    ListedNames.clear();
    std::size_t start = 0;
    for (std::size_t end = 0; (end = text.find('\n', start)) != std::string::npos; start = end + 1)
    {
      std::string line = text.substr(start, end - start);
      line = !line.empty() && line.back() == '\r' ? line.substr(0, line.size() - 1) : line;
      if (line.empty())
      {
        End = end + 1;
        return true;
      }
      this->ParseLine(line, start == 0);
      if (this->IsList())
      {
        return this->ParseNames(text.substr(end + 1), isWholeFile);
      }
    }
    return isWholeFile && start == text.size() && m_Values.count("datafile") != 0;
  }

  void
  ParseLine(const std::string & line, bool isFirst)
  {
    if (isFirst)
    {
      if (line.size() != 8 || line.compare(0, 7, "NRRD000") != 0 || line[7] < '1' || line[7] > '5')
      {
        FailToRead(m_Path, "it is not an NRRD of version 1 to 5");
      }
      return;
    }
    const auto colon = line.find(':');
    if (line[0] == '#')
    {
      return;
    }
    if (colon == std::string::npos)
    {
      FailToRead(m_Path, "its header has a line without ':'");
    }
    if (line.compare(colon, 2, ":=") == 0)
    {
      KeyValues[line.substr(0, colon)] = Unescape(line.substr(colon + 2));
      return;
    }
    const std::string name = NormaliseName(line.substr(0, colon));
    if (Fields.count(name) == 0 || line.compare(colon, 2, ": ") != 0)
    {
      FailToRead(m_Path, "its header has the unknown field '" + line.substr(0, colon) + "'");
    }
    if (!m_Values.emplace(name == "centerings" ? "centers" : name, Trim(line.substr(colon + 1))).second)
    {
      FailToRead(m_Path, "its header has the field '" + line.substr(0, colon) + "' twice");
    }
  }

  bool
  IsList() const
  {
    const auto found = m_Values.find("datafile");
    return found != m_Values.end() && found->second.compare(0, 4, "LIST") == 0;
  }

  bool
  ParseNames(const std::string & text, bool isWholeFile)
  {
    std::size_t start = 0;
    for (std::size_t end = 0; start < text.size(); start = end + 1)
    {
      end = std::min(text.find('\n', start), text.size());
      const std::string name = Trim(text.substr(start, end - start));
      if (!name.empty())
      {
        ListedNames.push_back(name);
      }
    }
    return isWholeFile;
  }

  std::string                        m_Path;
  std::map<std::string, std::string> m_Values;
};

/** "(1,0,0)" as numbers; nothing for "none". */
std::optional<std::vector<double>>
ParseVector(const std::string & path, const std::string & word, std::size_t count)
{
  if (word == "none")
  {
    return std::nullopt;
  }
  if (word.size() < 2 || word.front() != '(' || word.back() != ')')
  {
    FailToRead(path, "its header has '" + word + "' where a vector is due");
  }
  std::string inner = word.substr(1, word.size() - 2);
  std::replace(inner.begin(), inner.end(), ',', ' ');
  return ParseReals(path, "space directions", inner, count);
}

/** The words of a value, a vector in parentheses being one of them, even if it has blanks. */
std::vector<std::string>
SplitVectors(const std::string & text)
{
  std::vector<std::string> words;
  std::string              word;
  int                      depth = 0;
  for (const char c : text + " ")
  {
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c != ' ' && c != '\t')
    {
      word += c;
    }
    else if (depth <= 0 && !word.empty())
    {
      words.push_back(word);
      word.clear();
    }
    if (c == ')' && depth == 0)
    {
      words.push_back(word);
      word.clear();
    }
  }
  if (!word.empty())
  {
    words.push_back(word);
  }
  return words;
}

/** How many of the two first axes of the LPS space point the other way. */
std::vector<double>
GetSigns(const std::string & space, std::size_t dimension)
{
  std::vector<double> signs(dimension, 1.0);
  if (space == "right-anterior-superior" || space == "ras")
  {
    signs[0] = signs[1] = -1.0;
  }
  if (space == "left-anterior-superior" || space == "las")
  {
    signs[1] = -1.0;
  }
  return signs;
}

/** The number of coordinates of the space that the axes lie in; 0: the header speaks of none. */
std::size_t
GetSpaceDimension(const std::string & path, const NrrdFields & fields)
{
  const auto space = fields.Find("space");
  const auto dimension = fields.Find("spacedimension");
  if (space && dimension)
  {
    FailToRead(path, "its header has both 'space' and 'space dimension'");
  }
  if (dimension)
  {
    const std::int64_t number = ParseInteger(path, "space dimension", *dimension);
    if (number < 1 || number > 8)
    {
      FailToRead(path, "its space has " + *dimension + " dimensions");
    }
    return static_cast<std::size_t>(number);
  }
  static const std::set<std::string> spaces = {
    "right-anterior-superior", "left-anterior-superior", "left-posterior-superior", "ras", "las", "lps", "scanner-xyz",
    "3d-right-handed",         "3d-left-handed"
  };
  if (space && spaces.count(ToLower(*space)) == 0)
  {
    throw HeaderNotUnderstood("the space " + *space);
  }
  return space ? 3 : 0;
}

/** Reads where each axis lies, the first one perhaps being of components. */
class NrrdAxes
{
public:
  NrrdAxes(const std::string & path, const NrrdFields & fields)
    : m_Path(path)
    , m_Fields(fields)
    , m_SpaceDimension(GetSpaceDimension(path, fields))
  {
    const std::int64_t dimension = ParseInteger(path, "dimension", fields.Get("dimension"));
    if (dimension < 1 || dimension > 16)
    {
      FailToRead(path, "its header says that it has " + std::to_string(dimension) + " axes");
    }
    m_Count = static_cast<std::size_t>(dimension);
    m_Sizes = ParseSizes(path, "sizes", fields.Get("sizes"), m_Count);
    m_Kinds = SplitWords(fields.Find("kinds").value_or(""));
    if (!m_Kinds.empty() && m_Kinds.size() != m_Count)
    {
      FailToRead(path, "its header has not a kind for each axis");
    }
  }

  void
  Describe(ImageDescription & description) const
  {
    const bool  hasComponents = this->FindComponents(description);
    const auto  first = static_cast<std::ptrdiff_t>(hasComponents ? 1 : 0);
    ImageGrid & grid = description.Grid;
    grid.Size.assign(m_Sizes.begin() + first, m_Sizes.end());
    const std::size_t axes = grid.Size.size();
    grid.Spacing.assign(axes, 1.0);
    grid.Origin.assign(axes, 0.0);
    grid.Directions.assign(axes, std::vector<double>(axes, 0.0));
    for (std::size_t axis = 0; axis < axes; ++axis)
    {
      grid.Directions[axis][axis] = 1.0;
    }
    if (m_SpaceDimension > 0)
    {
      this->FindDirections(static_cast<std::size_t>(first), grid);
    }
    else
    {
      this->FindSpacings(static_cast<std::size_t>(first), grid);
    }
  }

private:
  /** Whether the first axis is of a voxel's components, and what they mean. */
  bool
  FindComponents(ImageDescription & description) const
  {
    static const std::map<std::string, VoxelKind> componentKinds = {
      { "rgb-color", VoxelKind::Rgb },           { "rgba-color", VoxelKind::Rgba },   { "complex", VoxelKind::Complex },
      { "vector", VoxelKind::Vector },           { "2-vector", VoxelKind::Vector },   { "3-vector", VoxelKind::Vector },
      { "4-vector", VoxelKind::Vector },         { "list", VoxelKind::Vector },       { "point", VoxelKind::Vector },
      { "covariant-vector", VoxelKind::Vector }, { "3-gradient", VoxelKind::Vector }, { "3-normal", VoxelKind::Vector },
    };
    for (std::size_t axis = 0; axis < m_Kinds.size(); ++axis)
    {
      const std::string kind = ToLower(m_Kinds[axis]);
      const auto        found = componentKinds.find(kind);
      const bool isDomain = kind == "domain" || kind == "space" || kind == "time" || kind == "none" || kind == "???";
      if (!isDomain && (axis > 0 || found == componentKinds.end()))
      {
        throw HeaderNotUnderstood("an axis of the kind " + kind);
      }
      if (!isDomain)
      {
        description.Kind = found->second;
        description.NumberOfComponents = this->GetComponents(kind);
      }
    }
    const bool hasComponents =
      !m_Kinds.empty() && description.NumberOfComponents != 0 && componentKinds.count(ToLower(m_Kinds[0])) != 0;
    description.Kind = hasComponents && description.NumberOfComponents == 1 ? VoxelKind::Scalar : description.Kind;
    return hasComponents;
  }

  unsigned int
  GetComponents(const std::string & kind) const
  {
    static const std::map<std::string, std::uint64_t> due = { { "rgb-color", 3 },  { "rgba-color", 4 },
                                                              { "complex", 2 },    { "2-vector", 2 },
                                                              { "3-vector", 3 },   { "4-vector", 4 },
                                                              { "3-gradient", 3 }, { "3-normal", 3 } };
    const auto                                        found = due.find(kind);
    if ((found != due.end() && found->second != m_Sizes[0]) || m_Sizes[0] > 1000000)
    {
      FailToRead(m_Path, "its axis of the kind " + kind + " has the size " + std::to_string(m_Sizes[0]));
    }
    return static_cast<unsigned int>(m_Sizes[0]);
  }

  void
  FindDirections(std::size_t first, ImageGrid & grid) const
  {
    const std::size_t axes = grid.Size.size();
    const auto        directions = m_Fields.Find("spacedirections");
    if (m_SpaceDimension != axes || !directions)
    {
      throw HeaderNotUnderstood("axes that are not as many as the coordinates of their space");
    }
    const std::vector<std::string> words = SplitVectors(*directions);
    if (words.size() != m_Count)
    {
      FailToRead(m_Path, "its header has not a space direction for each axis");
    }
    if (first == 1 && words[0] != "none")
    {
      throw HeaderNotUnderstood("components with a direction");
    }
    const auto signs = GetSigns(ToLower(m_Fields.Find("space").value_or("")), axes);
    for (std::size_t axis = 0; axis < axes; ++axis)
    {
      const auto vector = ParseVector(m_Path, words[first + axis], axes);
      if (!vector)
      {
        throw HeaderNotUnderstood("an axis without a direction");
      }
      double square = 0.0;
      for (const double number : *vector)
      {
        square += number * number;
      }
      grid.Spacing[axis] = std::sqrt(square);
      for (std::size_t i = 0; i < axes; ++i)
      {
        grid.Directions[axis][i] = signs[i] * (*vector)[i] / grid.Spacing[axis];
      }
    }
    const auto origin = ParseVector(m_Path, m_Fields.Find("spaceorigin").value_or("none"), axes);
    for (std::size_t i = 0; origin && i < axes; ++i)
    {
      grid.Origin[i] = signs[i] * (*origin)[i];
    }
  }

  /** Without a space, an axis has a spacing and a place of its own. */
  void
  FindSpacings(std::size_t first, ImageGrid & grid) const
  {
    if (m_Fields.Find("axismaxs") || m_Fields.Find("spacedirections"))
    {
      throw HeaderNotUnderstood("axes given by their ends");
    }
    const auto spacings = SplitWords(m_Fields.Find("spacings").value_or(""));
    const auto minima = SplitWords(m_Fields.Find("axismins").value_or(""));
    const auto centers = SplitWords(m_Fields.Find("centers").value_or(""));
    for (const auto * words : { &spacings, &minima, &centers })
    {
      if (!words->empty() && words->size() != m_Count)
      {
        FailToRead(m_Path, "its header has not a spacing, a least position or a centering for each axis");
      }
    }
    for (std::size_t axis = 0; axis < grid.Size.size(); ++axis)
    {
      const std::size_t i = first + axis;
      const double      spacing = spacings.empty() ? 1.0 : ParseReal(m_Path, "spacings", spacings[i]);
      grid.Spacing[axis] = std::isnan(spacing) ? 1.0 : spacing;
      const double minimum = minima.empty() ? std::nan("") : ParseReal(m_Path, "axis mins", minima[i]);
      const bool   isNode = !centers.empty() && ToLower(centers[i]) == "node";
      grid.Origin[axis] = std::isnan(minimum) ? 0.0 : minimum + (isNode ? 0.0 : grid.Spacing[axis] / 2.0);
    }
  }

  const std::string &        m_Path;
  const NrrdFields &         m_Fields;
  std::size_t                m_SpaceDimension;
  std::size_t                m_Count = 0;
  std::vector<std::uint64_t> m_Sizes;
  std::vector<std::string>   m_Kinds;
};

std::vector<std::string>
FindDataFiles(const std::string & path, const NrrdFields & fields)
{
  const std::string              value = fields.Find("datafile").value_or("");
  const std::vector<std::string> words = SplitWords(value);
  if (words.empty())
  {
    return {};
  }
  const bool isPattern = words.size() >= 4 && words[0].find('%') != std::string::npos;
  if ((words[0] == "LIST" && words.size() > 1) || (isPattern && words.size() > 4))
  {
    throw HeaderNotUnderstood("data files of another dimension");
  }
  if (words[0] == "LIST")
  {
    if (fields.ListedNames.empty())
    {
      FailToRead(path, "its header lists no data files");
    }
    return fields.ListedNames;
  }
  if (isPattern)
  {
    return ExpandPattern(path,
                         words[0],
                         ParseInteger(path, "data file", words[1]),
                         ParseInteger(path, "data file", words[2]),
                         ParseInteger(path, "data file", words[3]));
  }
  return { value };
}

/** What the header says besides the grid. A space that was turned into LPS is none of it, nor is what refers to it. */
void
CopyMetadata(const NrrdFields & fields, ImageDescription & description)
{
  description.Metadata = fields.KeyValues;
  const std::string space = ToLower(fields.Find("space").value_or("lps"));
  const bool        isTurned = GetSigns(space, 3) != std::vector<double>(3, 1.0);
  const bool        isLps = space == "lps" || space == "left-posterior-superior";
  for (const char * const name : { "content", "sample units", "space units", "units", "measurement frame", "space" })
  {
    const auto value = fields.Find(NormaliseName(name));
    const bool isOfSpace = std::string(name) == "measurement frame" || std::string(name) == "space";
    if (value && !(isOfSpace && isTurned) && !(std::string(name) == "space" && isLps))
    {
      description.Metadata[std::string("NRRD_") + name] = *value;
    }
  }
  description.IsLabelMap = fields.KeyValues.count("Segment0_LabelValue") != 0;
}

bool
IsBigEndian(const std::string & path, const NrrdFields & fields, ElementType type)
{
  const std::string endian = ToLower(fields.Find("endian").value_or(""));
  if (endian != "little" && endian != "big" && !(endian.empty() && itk::Subdivision::SizeOf(type) == 1))
  {
    FailToRead(path, "its header does not say whether the byte order is little or big");
  }
  return endian == "big";
}
} // namespace

PlainLayout
ReadNrrdHeader(const std::string & path)
{
  const InputFile    file(path);
  const NrrdFields   fields(file);
  PlainLayout        layout;
  ImageDescription & description = layout.Description;
  description.Format = "NRRD";
  const std::string type = ToLower(fields.Get("type"));
  const auto        known = Types.find(type);
  if (known == Types.end())
  {
    FailToRead(path, "voxels of the type '" + type + "' are not supported");
  }
  description.Component = known->second;
  const std::string encoding = ToLower(fields.Get("encoding"));
  layout.IsCompressed = encoding == "gz" || encoding == "gzip";
  if (!layout.IsCompressed && encoding != "raw")
  {
    throw HeaderNotUnderstood("the encoding " + encoding);
  }
  NrrdAxes(path, fields).Describe(description);
  CheckDescription(path, description);
  CopyMetadata(fields, description);
  layout.IsBigEndian = IsBigEndian(path, fields, description.Component);

  DataFiles files;
  files.HeaderEnd = fields.End;
  const std::int64_t lines = ParseInteger(path, "line skip", fields.Find("lineskip").value_or("0"));
  files.ByteSkip = ParseInteger(path, "byte skip", fields.Find("byteskip").value_or("0"));
  if (lines < 0 || files.ByteSkip < -1 || (layout.IsCompressed && files.ByteSkip < 0))
  {
    FailToRead(path, "its header has a negative number of lines or bytes to skip");
  }
  files.LineSkip = static_cast<std::uint64_t>(lines);
  files.Names = FindDataFiles(path, fields);
  if (layout.IsCompressed && files.Names.size() > 1)
  {
    throw HeaderNotUnderstood("several compressed data files");
  }
  layout.InflatedOffset = layout.IsCompressed ? static_cast<std::uint64_t>(files.ByteSkip) : 0;
  LocateData(path, files, layout);
  return layout;
}

bool
IsNrrdField(const std::string & name)
{
  return Fields.count(NormaliseName(name)) != 0;
}
