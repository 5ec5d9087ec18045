// SPDX-License-Identifier: Apache-2.0
#include "FuzzedFiles.h"

#include "itk/VtkFile.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <optional>
#include <sstream>

namespace
{
std::string
MakeSmall(std::string text)
{
  for (char & c : text)
  {
    c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  }
  return text;
}

/** Takes the lines of a text away from its start, as ITK's reader does: without the empty ones. */
std::optional<std::string>
TakeLine(std::string & text)
{
  while (!text.empty() && text[0] == '\n')
  {
    text.erase(0, 1);
  }
  const std::size_t end = text.find('\n');
  if (end == std::string::npos)
  {
    return std::nullopt;
  }
  const std::string line = MakeSmall(text.substr(0, end));
  text.erase(0, end + 1);
  return line;
}

/** Whether a line with POINT_DATA says a number of points that is not that of the image, or none. */
bool
SaysOtherPoints(const std::string & line, const std::uint64_t points)
{
  std::istringstream words(line);
  std::string        word;
  if (line.find("point_data") == std::string::npos || !(words >> word >> word))
  {
    return false;
  }
  char * end = nullptr;
  errno = 0;
  const long long number = std::strtoll(word.c_str(), &end, 10);
  return errno != 0 || end != word.c_str() + word.size() || number < 0 || static_cast<std::uint64_t>(number) != points;
}

/** The voxels and what follows them; nothing if the header is none that is supported. */
std::optional<std::string>
TakeHeader(std::string text, const std::uint64_t points)
{
  for (int i = 0; i < 4; ++i)
  {
    if (!TakeLine(text))
    {
      return std::nullopt;
    }
  }
  for (;;)
  {
    const auto line = TakeLine(text);
    if (!line || line->find("cell_data") != std::string::npos || SaysOtherPoints(*line, points))
    {
      return std::nullopt;
    }
    const bool isScalar = line->find("scalars") != std::string::npos;
    if (isScalar && line->find("color_scalars") == std::string::npos)
    {
      std::string rest = text;
      const auto  table = TakeLine(rest);
      return !table ? table : table->find("lookup_table") == std::string::npos ? text : rest;
    }
    if (isScalar || line->find("vector") != std::string::npos || line->find("tensors") != std::string::npos)
    {
      return text;
    }
  }
}

/** What may stand after the voxels, of some of the words that may and some that may not. */
enum class Rest
{
  Right,
  Wrong,
  Open
};

Rest
JudgeRest(const std::string & word)
{
  const std::string small = MakeSmall(word);
  if (small.empty() || small == "metadata" || small == "scalars" || small == "cell_data")
  {
    return Rest::Right;
  }
  return small.find_first_not_of("0123456789.-") == std::string::npos ? Rest::Wrong : Rest::Open;
}

struct Case
{
  std::string      Path;
  std::string      Text;
  ImageDescription Description;
  std::size_t      Numbers = 0; // in the file, of a voxel
};

/** Voxels as they stand, in either byte order: all of them must be there. */
void
FuzzBinary(const Case & file)
{
  const auto        voxels = TakeHeader(file.Text, file.Description.GetNumberOfVoxels());
  const std::size_t size = itk::Subdivision::SizeOf(file.Description.Component);
  const std::size_t expected = file.Description.GetNumberOfVoxels() * file.Numbers * size;
  bool              isRight = voxels && voxels->size() >= expected;
  std::string       word;
  if (isRight)
  {
    std::istringstream(voxels->substr(expected, 1024)) >> word;
    isRight = JudgeRest(word) == Rest::Right;
  }
  bool       isWarned = false;
  const auto warn = [&](const std::string &) { isWarned = true; };
  const bool isRefused = IsRefused([&] { CheckVtkVoxels(file.Path, file.Description, warn); });
  FuzzExpect(isRefused || isWarned || MakeSmall(word) != "scalars", "a VTK file's other values are left out silently");
  FuzzExpect(JudgeRest(word) == Rest::Open || isRefused != isRight,
             "a binary VTK file that is right is refused, or the other way round");
}

/** Where a number of a voxel that is read stands among those of the file. A symmetric tensor of three rows is read as
 * its upper triangle. */
std::size_t
GetPlace(const Case & file, const std::size_t number)
{
  constexpr std::size_t triangle[] = { 0, 1, 2, 4, 5, 8 };
  const std::size_t     components = file.Description.NumberOfComponents;
  const std::size_t     component = number % components;
  return number / components * file.Numbers + (file.Numbers == components ? component : triangle[component]);
}

void
FuzzText(const Case & file)
{
  const itk::Subdivision::ElementType type = file.Description.Component;
  const std::uint64_t                 voxels = file.Description.GetNumberOfVoxels();
  const std::size_t                   count = voxels * file.Numbers;
  std::vector<char>                   read;
  bool                                isWarned = false;
  const auto                          warn = [&](const std::string &) { isWarned = true; };
  const bool isRefused = IsRefused([&] { read = ReadVtkText(file.Path, file.Description, warn); });
  const auto text = TakeHeader(file.Text, voxels);
  FuzzExpect(text || isRefused, "a VTK file without a header is read");
  if (!text)
  {
    return;
  }
  std::istringstream      stream(*text);
  std::vector<FuzzedWord> words;
  std::string             word;
  for (; words.size() < count && stream >> word; words.push_back(ReadFuzzedWord(word, type)))
  {
  }
  word.clear();
  stream >> word;
  FuzzExpect(isRefused || isWarned || MakeSmall(word) != "scalars", "a VTK text's other values are left out silently");
  const bool isOpen = JudgeRest(word) == Rest::Open ||
                      std::any_of(words.begin(), words.end(), [](const FuzzedWord & number) { return number.IsOpen; });
  const bool isRight =
    words.size() == count && JudgeRest(word) == Rest::Right &&
    std::all_of(words.begin(), words.end(), [](const FuzzedWord & number) { return number.IsNumber; });
  FuzzExpect(isOpen || isRefused != isRight, "a VTK file of text that is right is refused, or the other way round");
  FuzzExpect(isRefused || read.size() == voxels * file.Description.GetVoxelBytes(), "VTK voxels of another size");
  for (std::size_t i = 0; !isRefused && i < voxels * file.Description.NumberOfComponents; ++i)
  {
    const std::size_t place = GetPlace(file, i);
    FuzzExpect(place < words.size() && AreBytesOf(words[place], type, &read[i * itk::Subdivision::SizeOf(type)]),
               "a VTK file of text has another number than its word");
  }
}
} // namespace

void
FuzzVtk(FuzzBytes & bytes, const FuzzFolder & folder)
{
  const bool isText = bytes.Below(2) == 0;
  Case       file;
  file.Description.Component = ChooseElementType(bytes);
  const unsigned int kind = bytes.Below(4);
  file.Description.Kind = kind == 0   ? VoxelKind::Scalar
                          : kind == 1 ? VoxelKind::Rgb
                          : kind == 2 ? VoxelKind::Vector
                                      : VoxelKind::SymmetricTensor;
  constexpr unsigned int components[] = { 1, 3, 3, 6 };
  constexpr unsigned int numbers[] = { 1, 3, 3, 9 };
  file.Description.NumberOfComponents = components[kind];
  file.Numbers = numbers[kind];
  for (int axis = 0; axis < 3; ++axis)
  {
    file.Description.Grid.Size.push_back(1 + bytes.Below(4));
  }
  file.Text = bytes.Rest();
  file.Path = folder.Write("image.vtk", file.Text);
  if (isText)
  {
    FuzzText(file);
  }
  else
  {
    FuzzBinary(file);
  }
}
