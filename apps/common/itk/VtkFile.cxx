// SPDX-License-Identifier: Apache-2.0
#include "itk/VtkFile.h"
#include "system/files/InputFile.h"
#include "text/HeaderText.h"
#include "text/TextNumbers.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <sstream>

namespace
{
constexpr std::uint64_t MostOfPart = 1 << 20; // bytes of a text
constexpr std::uint64_t MostOfRest = 1 << 16; // that are looked at
constexpr std::uint64_t TensorNumbers = 9;    // in the file, of which six differ

/** Words that values begin with. */
const std::set<std::string> ArrayKeywords = {
  "scalars",  "color_scalars", "vectors",    "normals",      "texture_coordinates", "tensors",
  "tensors6", "field",         "global_ids", "pedigree_ids", "edge_flags"
};

/** The values that are read. */
struct Values
{
  std::uint64_t Start = 0;
  std::string   Name;
  bool          AreFirst = true;
};

/** Lines one by one, without the empty ones. */
class Lines
{
public:
  explicit Lines(const InputFile & file)
    : m_Path(file.GetPath())
    , m_Text(file.ReadTextAt(0, 1 << 16))
  {}

  std::string
  GetNext()
  {
    std::string line;
    while (line.empty())
    {
      const auto end = m_Text.find('\n', Place);
      if (end == std::string::npos)
      {
        FailToRead(m_Path, "it is truncated");
      }
      line = m_Text.substr(Place, end - Place);
      Place = end + 1;
    }
    Line = line;
    return ToLower(line);
  }

  std::size_t Place = 0;
  std::string Line; // as it stands

private:
  std::string m_Path;
  std::string m_Text;
};

bool
Has(const std::string & line, const char * word)
{
  return line.find(word) != std::string::npos;
}

void
CheckPoints(const std::string & path, const std::string & number, const std::uint64_t voxels)
{
  const std::uint64_t points = ParseSizes(path, "POINT_DATA", number, 1).front();
  if (points != voxels)
  {
    FailToRead(path,
               "its header says " + std::to_string(points) + " points (POINT_DATA), but its dimensions are those of " +
                 std::to_string(voxels));
  }
}

/** Whether a line begins values. */
bool
IsOfArray(const std::string & line)
{
  const std::vector<std::string> words = SplitWords(line);
  return !words.empty() && ArrayKeywords.count(ToLower(words.front())) > 0;
}

/** A slice becomes an image of two axes. */
void
WarnOfPosition(const std::string &              path,
               const std::vector<std::string> & origin,
               const ImageDescription &         description,
               const WarningSink &              warn)
{
  double z = 0.0;
  if (origin.size() > 3 && description.Grid.Size.size() < 3 && (std::istringstream(origin[3]) >> z) && z != 0.0)
  {
    warn(path + " is placed in space, where an image of 2 axes cannot be: its position across those is left out");
  }
}

/** Reads the header, and checks that it says as many points as its dimensions do. */
Values
FindVoxels(const InputFile & file, const ImageDescription & description, const WarningSink & warn)
{
  constexpr int linesBefore = 4; // version, title, encoding, kind of the dataset
  Lines         lines(file);
  Values        values;
  for (int i = 0; i < linesBefore; ++i)
  {
    lines.GetNext();
  }
  for (;;)
  {
    const std::string              line = lines.GetNext();
    const std::vector<std::string> words = SplitWords(line);
    if (Has(line, "cell_data"))
    {
      FailToRead(file.GetPath(), "its values are of cells (CELL_DATA), of which only those of points are supported");
    }
    if (Has(line, "point_data") && words.size() > 1)
    {
      CheckPoints(file.GetPath(), words[1], description.GetNumberOfVoxels());
    }
    if (Has(line, "origin"))
    {
      WarnOfPosition(file.GetPath(), words, description, warn);
    }
    if (Has(line, "vector") || Has(line, "scalars") || Has(line, "tensors"))
    {
      const std::size_t place = lines.Place;
      const auto        inOwnCase = SplitWords(lines.Line);
      values.Name = inOwnCase.size() > 1 ? inOwnCase[1] : "";
      const bool hasTable = Has(line, "scalars") && !Has(line, "color_scalars") && Has(lines.GetNext(), "lookup_table");
      values.Start = hasTable ? lines.Place : place;
      return values;
    }
    values.AreFirst = values.AreFirst && !IsOfArray(line);
  }
}

/** Other values and notes may follow. */
void
CheckRest(const std::string & path, const std::string & word)
{
  static const std::set<std::string> others = { "lookup_table", "metadata", "cell_data", "point_data" };
  if (!word.empty() && !IsOfArray(word) && others.count(ToLower(word)) == 0)
  {
    FailToRead(path,
               "it holds more voxels than its header says; the size or the type of the image in the header is wrong");
  }
}

/** \param word the first after the values that are read
 * \param rest begins with it or before */
void
WarnOfOtherArrays(const std::string & path,
                  const Values &      values,
                  const std::string & word,
                  const std::string & rest,
                  const WarningSink & warn)
{
  bool               areAlone = values.AreFirst && !IsOfArray(word);
  std::istringstream lines(rest);
  for (std::string line; areAlone && std::getline(lines, line);)
  {
    areAlone = !IsOfArray(line);
  }
  if (!areAlone)
  {
    warn(path + " holds several arrays of values, of which only '" + values.Name + "' is read");
  }
}

/** Numbers in the file. */
std::uint64_t
CountNumbers(const ImageDescription & description)
{
  const bool isTensor = description.Kind == VoxelKind::SymmetricTensor;
  return description.GetNumberOfVoxels() * (isTensor ? TensorNumbers : description.NumberOfComponents);
}
} // namespace

void
CheckVtkVoxels(const std::string & path, const ImageDescription & description, const WarningSink & warn)
{
  const InputFile     file(path);
  const Values        values = FindVoxels(file, description, warn);
  const std::uint64_t expected = CountNumbers(description) * itk::Subdivision::SizeOf(description.Component);
  const std::uint64_t available = file.GetSize() - values.Start;
  if (available < expected)
  {
    FailToRead(path,
               "it is truncated, with " + std::to_string(available) + " of " + std::to_string(expected) +
                 " bytes of data");
  }
  const std::string              rest = file.ReadTextAt(values.Start + expected, MostOfRest);
  const std::vector<std::string> words = SplitWords(rest.substr(0, 1 << 10));
  const std::string              word = words.empty() ? "" : words.front();
  CheckRest(path, word);
  WarnOfOtherArrays(path, values, word, rest, warn);
}

std::vector<char>
ReadVtkText(const std::string & path, const ImageDescription & description, const WarningSink & warn)
{
  const std::uint64_t count = CountNumbers(description);
  const std::size_t   elementBytes = itk::Subdivision::SizeOf(description.Component);
  const InputFile     file(path);
  const Values        values = FindVoxels(file, description, warn);
  if (file.GetSize() - values.Start < count)
  {
    FailToRead(path, "it is truncated, with too few characters for " + std::to_string(count) + " numbers");
  }
  std::vector<char> bytes(static_cast<std::size_t>(count * elementBytes));
  TextNumbers       numbers(path, description.Component, count, bytes.data());
  std::uint64_t     last = values.Start; // part of the numbers
  for (std::uint64_t place = values.Start; place < file.GetSize();)
  {
    const std::string part = file.ReadTextAt(place, MostOfPart);
    last = numbers.AreAll() ? last : place;
    numbers.Add(part);
    place += std::max<std::size_t>(part.size(), 1);
  }
  const std::string word = numbers.Finish();
  CheckRest(path, word);
  WarnOfOtherArrays(path, values, word, file.ReadTextAt(last, MostOfPart + MostOfRest), warn);
  if (description.Kind == VoxelKind::SymmetricTensor)
  {
    const std::uint64_t                  voxels = description.GetNumberOfVoxels();
    constexpr std::array<std::size_t, 6> upper = { 0, 1, 2, 4, 5, 8 };
    char *                               to = bytes.data();
    for (std::uint64_t voxel = 0; voxel < voxels; ++voxel)
    {
      for (const std::size_t number : upper)
      {
        std::memmove(to, bytes.data() + (voxel * TensorNumbers + number) * elementBytes, elementBytes);
        to += elementBytes;
      }
    }
    bytes.resize(static_cast<std::size_t>(voxels * description.GetVoxelBytes()));
  }
  return bytes;
}
