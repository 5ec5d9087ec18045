// SPDX-License-Identifier: Apache-2.0
#include "headers/NrrdAxes.h"
#include "text/HeaderText.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace
{
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

/** Whether an axis of a kind, in small letters, is one of the grid. */
bool
IsDomain(const std::string & kind)
{
  return kind == "domain" || kind == "space" || kind == "time" || kind == "none" || kind == "???";
}

/** The space of a space with time, as NRRD names both: RAS of RAST; any other as it is. */
std::string
RemoveTime(const std::string & space)
{
  const std::string ending = "-time";
  const bool        isLong = space.size() > ending.size() && space.substr(space.size() - ending.size()) == ending;
  const bool        isShort = space == "rast" || space == "last" || space == "lpst";
  return isLong ? space.substr(0, space.size() - ending.size()) : isShort ? space.substr(0, 3) : space;
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
  if (!space)
  {
    return 0;
  }
  const std::string name = ToLower(*space);
  const std::string withoutTime = RemoveTime(name);
  if (spaces.count(withoutTime) == 0)
  {
    FailToRead(path, "its space " + *space + " is none of NRRD's");
  }
  return name == withoutTime ? 3 : 4;
}
} // namespace

std::vector<double>
GetSigns(const std::string & name, std::size_t dimension)
{
  const std::string   space = RemoveTime(name);
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

NrrdAxes::NrrdAxes(const std::string & path, const NrrdFields & fields)
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
  m_Order.resize(m_Count);
  std::iota(m_Order.begin(), m_Order.end(), std::size_t{ 0 });
}

void
NrrdAxes::MoveComponentsFirst()
{
  if (m_Kinds.empty() || IsDomain(ToLower(m_Kinds.back())))
  {
    return;
  }
  std::rotate(m_Kinds.rbegin(), m_Kinds.rbegin() + 1, m_Kinds.rend());
  std::rotate(m_Sizes.rbegin(), m_Sizes.rbegin() + 1, m_Sizes.rend());
  std::rotate(m_Order.rbegin(), m_Order.rbegin() + 1, m_Order.rend());
}

void
NrrdAxes::Describe(ImageDescription & description) const
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

bool
NrrdAxes::FindComponents(ImageDescription & description) const
{
  static const std::map<std::string, VoxelKind> componentKinds = {
    { "rgb-color", VoxelKind::Rgb },
    { "rgba-color", VoxelKind::Rgba },
    { "complex", VoxelKind::Complex },
    { "vector", VoxelKind::Vector },
    { "2-vector", VoxelKind::Vector },
    { "3-vector", VoxelKind::Vector },
    { "4-vector", VoxelKind::Vector },
    { "list", VoxelKind::Vector },
    { "point", VoxelKind::Vector },
    { "covariant-vector", VoxelKind::Vector },
    { "3-gradient", VoxelKind::Vector },
    { "3-normal", VoxelKind::Vector },
    { "3d-symmetric-matrix", VoxelKind::SymmetricTensor },
  };
  for (std::size_t axis = 0; axis < m_Kinds.size(); ++axis)
  {
    const std::string kind = ToLower(m_Kinds[axis]);
    const auto        found = componentKinds.find(kind);
    if (kind.find("masked") != std::string::npos)
    {
      FailToRead(m_Path,
                 "its voxels are of the kind " + m_Kinds[axis] +
                   ", of which the mask cannot be kept; save them as a vector, or without the mask");
    }
    const bool isDomain = IsDomain(kind);
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
NrrdAxes::GetComponents(const std::string & kind) const
{
  static const std::map<std::string, std::uint64_t> due = {
    { "rgb-color", 3 }, { "rgba-color", 4 }, { "complex", 2 },  { "2-vector", 2 },           { "3-vector", 3 },
    { "4-vector", 4 },  { "3-gradient", 3 }, { "3-normal", 3 }, { "3d-symmetric-matrix", 6 }
  };
  const auto found = due.find(kind);
  if ((found != due.end() && found->second != m_Sizes[0]) || m_Sizes[0] > 1000000)
  {
    FailToRead(m_Path, "its axis of the kind " + kind + " has the size " + std::to_string(m_Sizes[0]));
  }
  return static_cast<unsigned int>(m_Sizes[0]);
}

void
NrrdAxes::FindDirections(std::size_t first, ImageGrid & grid) const
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
  if (first == 1 && words[m_Order[0]] != "none")
  {
    throw HeaderNotUnderstood("components with a direction");
  }
  const auto signs = GetSigns(ToLower(m_Fields.Find("space").value_or("")), axes);
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    const auto vector = ParseVector(m_Path, words[m_Order[first + axis]], axes);
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

void
NrrdAxes::FindSpacings(std::size_t first, ImageGrid & grid) const
{
  if (m_Fields.Find("spacedirections"))
  {
    throw HeaderNotUnderstood("directions without a space");
  }
  const auto spacings = SplitWords(m_Fields.Find("spacings").value_or(""));
  const auto minima = SplitWords(m_Fields.Find("axismins").value_or(""));
  const auto maxima = SplitWords(m_Fields.Find("axismaxs").value_or(""));
  const auto centers = SplitWords(m_Fields.Find("centers").value_or(""));
  for (const auto * words : { &spacings, &minima, &maxima, &centers })
  {
    if (!words->empty() && words->size() != m_Count)
    {
      FailToRead(m_Path, "its header has not a spacing, a least or greatest position or a centering for each axis");
    }
  }
  for (std::size_t axis = 0; axis < grid.Size.size(); ++axis)
  {
    const std::size_t i = m_Order[first + axis];
    const auto        parse = [&](const char * field, const std::vector<std::string> & words) {
      return words.empty() ? std::nan("") : ParseReal(m_Path, field, words[i]);
    };
    const bool   isNode = !centers.empty() && ToLower(centers[i]) == "node";
    const double minimum = parse("axis mins", minima);
    const double steps = static_cast<double>(grid.Size[axis]) - (isNode ? 1.0 : 0.0);
    const double between = (parse("axis maxs", maxima) - minimum) / steps;
    const double spacing = parse("spacings", spacings);
    grid.Spacing[axis] = !std::isnan(spacing) ? spacing : std::isfinite(between) ? between : 1.0;
    grid.Origin[axis] = std::isnan(minimum) ? 0.0 : minimum + (isNode ? 0.0 : grid.Spacing[axis] / 2.0);
  }
}
