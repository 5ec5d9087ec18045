// SPDX-License-Identifier: Apache-2.0
// The readers of MetaImage and NRRD on whole files that a fuzzer makes up. What they accept must be a grid whose voxels
// are within the files; its voxels are read, whole and in part; and the headers that the writers compose of it must be
// read as the same grid.

#include "FuzzBytes.h"
#include "FuzzFolder.h"

#include "headers/MetaHeader.h"
#include "headers/NrrdHeader.h"
#include "headers/PlainHeader.h"
#include "plain/PlainReader.h"
#include "system/files/InputFile.h"
#include "text/HeaderText.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <vector>

namespace
{

constexpr std::uint64_t MostBytes = 1 << 16;

void
CheckGrid(const ImageDescription & description)
{
  const ImageGrid & grid = description.Grid;
  const std::size_t axes = grid.Size.size();
  FuzzExpect(axes >= 1 && axes <= 4 && grid.Spacing.size() == axes && grid.Origin.size() == axes &&
               grid.Directions.size() == axes,
             "a grid without an entry for each axis");
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    FuzzExpect(grid.Size[axis] > 0, "an empty axis");
    FuzzExpect(grid.Spacing[axis] > 0.0 && std::isfinite(grid.Spacing[axis]), "a spacing that is none");
    FuzzExpect(std::isfinite(grid.Origin[axis]) && grid.Directions[axis].size() == axes, "an origin that is none");
    double square = 0.0;
    for (const double number : grid.Directions[axis])
    {
      square += number * number;
    }
    FuzzExpect(std::abs(square - 1.0) < 1e-3, "a direction that is no unit vector");
  }
  FuzzExpect(description.NumberOfComponents > 0, "voxels without components");
}

void
CheckSections(const PlainLayout & layout)
{
  std::uint64_t bytes = 0;
  for (const FileSection & section : layout.Sections)
  {
    const std::uint64_t size = InputFile(section.Path).GetSize();
    FuzzExpect(section.Offset <= size && section.Size <= size - section.Offset, "voxels beyond the end of a file");
    bytes += section.Size;
  }
  const ImageDescription & description = layout.Description;
  FuzzExpect(layout.Encoding != PlainEncoding::Raw || bytes == description.GetBytes(),
             "more or fewer bytes than the voxels have");
}

bool
IsBigEndianMachine()
{
  const std::uint16_t one = 1;
  return *reinterpret_cast<const unsigned char *>(&one) == 0;
}

/** The bytes whose hexadecimal digits stand in a part of a file, as the machine's elements; nothing if that is not all
 * that stands there. */
std::optional<std::string>
DecodeHex(const FileSection & section, const std::size_t elementSize, const bool isBigEndian)
{
  std::string digits;
  for (const char c : InputFile(section.Path).ReadTextAt(section.Offset, section.Size))
  {
    if (std::isxdigit(static_cast<unsigned char>(c)) != 0)
    {
      digits += c;
    }
    else if (std::isspace(static_cast<unsigned char>(c)) == 0)
    {
      return std::nullopt;
    }
  }
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
  {
    bytes += static_cast<char>(std::stoul(digits.substr(i, 2), nullptr, 16));
  }
  for (std::size_t i = 0; isBigEndian != IsBigEndianMachine() && i + elementSize <= bytes.size(); i += elementSize)
  {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                 bytes.begin() + static_cast<std::ptrdiff_t>(i + elementSize));
  }
  return digits.size() % 2 == 0 ? std::make_optional(bytes) : std::nullopt;
}

/** Voxels in one file as hexadecimal digits are those of the digits, and refused if they are more or fewer. */
void
CheckHex(const PlainLayout & layout, const std::vector<char> & voxels, const bool isRead)
{
  if (layout.Encoding != PlainEncoding::Hex || layout.Sections.size() != 1)
  {
    return;
  }
  const auto bytes =
    DecodeHex(layout.Sections[0], itk::Subdivision::SizeOf(layout.Description.Component), layout.IsBigEndian);
  FuzzExpect(isRead == (bytes && bytes->size() == layout.Description.GetBytes()),
             "digits that are right are refused, or the other way round");
  FuzzExpect(!isRead || std::equal(voxels.begin(), voxels.end(), bytes->begin()), "voxels other than their digits");
}

/** Reads all voxels, then the last one of each axis. What is compressed or text shows only then that it is damaged. */
void
ReadVoxels(const std::string & path, const bool isNrrd, const PlainLayout & layout)
{
  if (layout.Description.GetBytes() > MostBytes)
  {
    return;
  }
  std::vector<char> voxels;
  bool              isRead = true;
  try
  {
    const auto               reader = isNrrd ? OpenNrrd(path) : OpenMetaImage(path);
    const ImageDescription & description = reader->GetDescription();
    itk::Subdivision::Box    all;
    itk::Subdivision::Box    last;
    for (const std::uint64_t size : description.Grid.Size)
    {
      all.push_back({ 0, size });
      last.push_back({ static_cast<std::int64_t>(size) - 1, 1 });
    }
    voxels.resize(description.GetBytes());
    std::vector<char> voxel(description.GetVoxelBytes());
    reader->Read(all, voxels.data());
    reader->Read(last, voxel.data());
    FuzzExpect(std::equal(voxel.begin(), voxel.end(), voxels.end() - static_cast<std::ptrdiff_t>(voxel.size())),
               "a part has other voxels than the whole");
  }
  catch (const std::runtime_error &)
  {
    FuzzExpect(layout.Encoding != PlainEncoding::Raw, "voxels that were found cannot be read");
    isRead = false;
  }
  CheckHex(layout, voxels, isRead);
}

bool
AreClose(const double a, const double b, const double unit)
{
  return std::abs(a - b) <= 1e-6 * unit;
}

/** Whether all squares of the grid's numbers are numbers, as NRRD's vectors need it. */
bool
IsModerate(const ImageGrid & grid)
{
  return std::all_of(
    grid.Spacing.begin(), grid.Spacing.end(), [](const double spacing) { return spacing > 1e-100 && spacing < 1e100; });
}

void
CheckRoundTrip(const FuzzFolder & folder, const ImageDescription & description, const OutputOptions & options)
{
  const std::uint64_t bytes = description.GetBytes();
  if (bytes > MostBytes || !IsModerate(description.Grid))
  {
    return;
  }
  for (const char * const name : { "output.mha", "output.nrrd" })
  {
    const std::string path = folder.GetPath(name);
    const PlainHeader header = ComposePlainHeader(path, description, options);
    folder.Write(name, header.Text + std::string(bytes, '\0'));
    ImageDescription found;
    try
    {
      found = (header.IsNrrd ? ReadNrrdHeader(path) : ReadMetaHeader(path)).Description;
    }
    catch (const std::runtime_error & error)
    {
      FuzzExpect(false, std::string("the header that was written is refused: ") + error.what());
    }
    FuzzExpect(found.Grid.Size == description.Grid.Size && found.Component == description.Component &&
                 found.NumberOfComponents == description.NumberOfComponents,
               "the header that was written says other sizes or types");
    FuzzExpect(!header.IsNrrd || found.Kind == description.Kind,
               "the header that was written says that the components mean something else");
    for (std::size_t axis = 0; axis < found.Grid.Size.size(); ++axis)
    {
      const double spacing = description.Grid.Spacing[axis];
      FuzzExpect(AreClose(found.Grid.Spacing[axis], spacing, 1e3 * spacing) &&
                   found.Grid.Origin[axis] == description.Grid.Origin[axis],
                 "the header that was written says another spacing or origin");
      for (std::size_t i = 0; i < found.Grid.Size.size(); ++i)
      {
        FuzzExpect(AreClose(found.Grid.Directions[axis][i], description.Grid.Directions[axis][i], 1e3),
                   "the header that was written says another direction");
      }
    }
  }
}

/** What is said of an image whose components may be the last axis; its numbers are read elsewhere. */
void
CheckNrrdDescription(const std::string & path)
{
  try
  {
    CheckGrid(DescribeNrrd(path));
  }
  catch (const std::runtime_error &)
  {}
}

} // namespace

int
LLVMFuzzerTestOneInput(const std::uint8_t * const data, const std::size_t size)
{
  static const FuzzFolder folder;
  FuzzBytes               bytes(data, size);
  const unsigned int      choice = bytes.Byte();
  const bool              isNrrd = (choice & 1) != 0;
  OutputOptions           options;
  options.KeepMetadata = (choice & 2) != 0;
  const std::string path = folder.Write(isNrrd ? "input.nrrd" : "input.mha", bytes.Rest());
  if (isNrrd)
  {
    CheckNrrdDescription(path);
  }
  PlainLayout layout;
  try
  {
    layout = isNrrd ? ReadNrrdHeader(path) : ReadMetaHeader(path);
  }
  catch (const std::runtime_error &)
  {
    return 0;
  }
  CheckGrid(layout.Description);
  CheckSections(layout);
  ReadVoxels(path, isNrrd, layout);
  CheckRoundTrip(folder, layout.Description, options);
  return 0;
}
