// SPDX-License-Identifier: Apache-2.0
#include "itk/VtkFile.h"
#include "system/files/InputFile.h"
#include "text/HeaderText.h"
#include "text/TextNumbers.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

namespace
{
constexpr std::uint64_t TensorNumbers = 9; // in the file, of which six differ

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
    return ToLower(line);
  }

  std::size_t Place = 0;

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

/** Reads the header, and checks that it says as many points as its dimensions do.
 * \return where the first voxels start */
std::uint64_t
FindVoxels(const InputFile & file, const ImageDescription & description)
{
  constexpr int linesBefore = 4; // version, title, encoding, kind of the dataset
  Lines         lines(file);
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
    if (Has(line, "vector") || Has(line, "scalars") || Has(line, "tensors"))
    {
      const std::size_t place = lines.Place;
      const bool hasTable = Has(line, "scalars") && !Has(line, "color_scalars") && Has(lines.GetNext(), "lookup_table");
      return hasTable ? lines.Place : place;
    }
  }
}

/** Other values and notes may follow. */
void
CheckRest(const std::string & path, const std::string & word)
{
  static const std::set<std::string> keywords = {
    "scalars",      "color_scalars", "lookup_table", "vectors",  "normals",   "texture_coordinates",
    "tensors",      "tensors6",      "field",        "metadata", "cell_data", "global_ids",
    "pedigree_ids", "edge_flags",    "point_data",
  };
  if (!word.empty() && keywords.count(ToLower(word)) == 0)
  {
    FailToRead(path,
               "it holds more voxels than its header says; the size or the type of the image in the header is wrong");
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
CheckVtkVoxels(const std::string & path, const ImageDescription & description)
{
  const InputFile     file(path);
  const std::uint64_t start = FindVoxels(file, description);
  const std::uint64_t expected = CountNumbers(description) * itk::Subdivision::SizeOf(description.Component);
  const std::uint64_t available = file.GetSize() - start;
  if (available < expected)
  {
    FailToRead(path,
               "it is truncated, with " + std::to_string(available) + " of " + std::to_string(expected) +
                 " bytes of data");
  }
  const std::vector<std::string> words = SplitWords(file.ReadTextAt(start + expected, 1 << 10));
  CheckRest(path, words.empty() ? "" : words.front());
}

std::vector<char>
ReadVtkText(const std::string & path, const ImageDescription & description)
{
  const std::uint64_t count = CountNumbers(description);
  const std::size_t   elementBytes = itk::Subdivision::SizeOf(description.Component);
  const InputFile     file(path);
  const std::uint64_t start = FindVoxels(file, description);
  if (file.GetSize() - start < count)
  {
    FailToRead(path, "it is truncated, with too few characters for " + std::to_string(count) + " numbers");
  }
  std::vector<char> bytes(static_cast<std::size_t>(count * elementBytes));
  TextNumbers       numbers(path, description.Component, count, bytes.data());
  for (std::uint64_t place = start; place < file.GetSize();)
  {
    const std::string part = file.ReadTextAt(place, 1 << 20);
    numbers.Add(part);
    place += std::max<std::size_t>(part.size(), 1);
  }
  CheckRest(path, numbers.Finish());
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
