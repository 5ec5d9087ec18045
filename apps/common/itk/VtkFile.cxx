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

/** What a header says of the first voxels that follow it. */
struct VtkHeader
{
  std::uint64_t Size = 0;   // where the voxels start
  std::uint64_t Points = 0; // 0: not said
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

VtkHeader
ReadHeader(const InputFile & file)
{
  constexpr int linesBefore = 4; // version, title, encoding, kind of the dataset
  Lines         lines(file);
  VtkHeader     header;
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
      header.Points = ParseSizes(file.GetPath(), "POINT_DATA", words[1], 1).front();
    }
    if (Has(line, "vector") || Has(line, "scalars") || Has(line, "tensors"))
    {
      const std::size_t place = lines.Place;
      const bool hasTable = Has(line, "scalars") && !Has(line, "color_scalars") && Has(lines.GetNext(), "lookup_table");
      lines.Place = hasTable ? lines.Place : place;
      header.Size = lines.Place;
      return header;
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

/** Reads the header, and checks that it says as many points as its dimensions do. */
VtkHeader
ReadHeader(const InputFile & file, const ImageDescription & description)
{
  const VtkHeader     header = ReadHeader(file);
  const std::uint64_t voxels = description.GetNumberOfVoxels();
  if (header.Points != 0 && header.Points != voxels)
  {
    FailToRead(file.GetPath(),
               "its header says " + std::to_string(header.Points) +
                 " points (POINT_DATA), but its dimensions are those of " + std::to_string(voxels));
  }
  return header;
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
  const VtkHeader     header = ReadHeader(file, description);
  const std::uint64_t expected = CountNumbers(description) * itk::Subdivision::SizeOf(description.Component);
  const std::uint64_t available = file.GetSize() - header.Size;
  if (available < expected)
  {
    FailToRead(path,
               "it is truncated, with " + std::to_string(available) + " of " + std::to_string(expected) +
                 " bytes of data");
  }
  const std::vector<std::string> words = SplitWords(file.ReadTextAt(header.Size + expected, 1 << 10));
  CheckRest(path, words.empty() ? "" : words.front());
}

std::vector<char>
ReadVtkText(const std::string & path, const ImageDescription & description)
{
  const std::uint64_t count = CountNumbers(description);
  const std::size_t   elementBytes = itk::Subdivision::SizeOf(description.Component);
  const InputFile     file(path);
  const VtkHeader     header = ReadHeader(file, description);
  if (file.GetSize() - header.Size < count)
  {
    FailToRead(path, "it is truncated, with too few characters for " + std::to_string(count) + " numbers");
  }
  std::vector<char> bytes(static_cast<std::size_t>(count * elementBytes));
  TextNumbers       numbers(path, description.Component, count, bytes.data());
  for (std::uint64_t place = header.Size; place < file.GetSize();)
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
