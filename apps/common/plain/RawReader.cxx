// SPDX-License-Identifier: Apache-2.0
#include "plain/RawReader.h"
#include "plain/PlainReader.h"
#include "system/files/InputFile.h"
#include "volumes/GridOverrides.h"

#include <limits>
#include <map>
#include <stdexcept>

using itk::Subdivision::ElementType;

namespace
{
[[noreturn]] void
FailToParse(const std::string & text, const std::string & reason)
{
  throw std::invalid_argument('\'' + text + "': " + reason + "; an example is 1024x1024x800:uint16");
}

std::uint64_t
ParseNumber(const std::string & text, const std::string & number)
{
  if (number.empty() || number.size() > 18 || number.find_first_not_of("0123456789") != std::string::npos)
  {
    FailToParse(text, '\'' + number + "' is no number");
  }
  return std::stoull(number);
}

std::vector<std::string>
SplitAt(const std::string & text, char separator)
{
  std::vector<std::string> parts(1);
  for (const char character : text)
  {
    if (character == separator)
    {
      parts.emplace_back();
    }
    else
    {
      parts.back() += character;
    }
  }
  return parts;
}

ElementType
ParseType(const std::string & text, const std::string & name)
{
  static const std::map<std::string, ElementType> aliases = { { "float32", ElementType::Float },
                                                              { "float64", ElementType::Double } };
  std::string                                     names;
  for (int i = 0; i <= static_cast<int>(ElementType::Double); ++i)
  {
    const auto type = static_cast<ElementType>(i);
    if (name == itk::Subdivision::GetName(type))
    {
      return type;
    }
    names += std::string(i == 0 ? "" : ", ") + itk::Subdivision::GetName(type);
  }
  const auto alias = aliases.find(name);
  if (alias == aliases.end())
  {
    FailToParse(text, "the type '" + name + "' is none of " + names);
  }
  return alias->second;
}

/** Bytes of all voxels; what does not fit 63 bits is refused. */
std::uint64_t
CountBytes(const std::string & text, const RawLayout & layout)
{
  std::uint64_t bytes = layout.NumberOfComponents * itk::Subdivision::SizeOf(layout.Component);
  for (const std::uint64_t size : layout.Size)
  {
    if (size == 0)
    {
      FailToParse(text, "sizes are greater than 0");
    }
    if (bytes > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()) / size)
    {
      FailToParse(text, "no file is as large as that");
    }
    bytes *= size;
  }
  return bytes;
}

ImageDescription
Describe(const RawLayout & layout)
{
  const std::size_t axes = layout.Size.size();
  ImageDescription  description;
  description.Component = layout.Component;
  description.NumberOfComponents = layout.NumberOfComponents;
  description.Kind = layout.NumberOfComponents > 1 ? VoxelKind::Vector : VoxelKind::Scalar;
  description.Format = "raw";
  description.Grid.Size = layout.Size;
  description.Grid.Spacing.assign(axes, 1.0);
  description.Grid.Origin.assign(axes, 0.0);
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    description.Grid.Directions.emplace_back(axes, 0.0);
    description.Grid.Directions.back()[axis] = 1.0;
  }
  return description;
}
} // namespace

RawLayout
ParseRawLayout(const std::string & text)
{
  RawLayout         layout;
  std::string       rest = text;
  const std::size_t plus = text.find('+');
  if (plus != std::string::npos)
  {
    layout.HeaderBytes = ParseNumber(text, text.substr(plus + 1));
    rest = text.substr(0, plus);
  }
  const std::vector<std::string> parts = SplitAt(rest, ':');
  if (parts.size() < 2)
  {
    FailToParse(text, "a type is missing after the sizes");
  }
  for (const std::string & size : SplitAt(parts[0], 'x'))
  {
    layout.Size.push_back(ParseNumber(text, size));
  }
  if (layout.Size.size() < 2 || layout.Size.size() > 4)
  {
    FailToParse(text, "2 to 4 sizes are needed");
  }
  layout.Component = ParseType(text, parts[1]);
  for (std::size_t i = 2; i < parts.size(); ++i)
  {
    const bool isNumber = !parts[i].empty() && parts[i].find_first_not_of("0123456789") == std::string::npos;
    if (parts[i] == "big" || parts[i] == "little")
    {
      layout.IsBigEndian = parts[i] == "big";
    }
    else if (isNumber && parts[i].size() < 5 && parts[i] != std::string(parts[i].size(), '0'))
    {
      layout.NumberOfComponents = static_cast<unsigned int>(ParseNumber(text, parts[i]));
    }
    else
    {
      FailToParse(text, "'" + parts[i] + "' is neither big, little nor a number of components");
    }
  }
  CountBytes(text, layout);
  return layout;
}

std::unique_ptr<VolumeReader>
OpenRaw(const std::string & path, const InputOptions & options, const WarningSink & warn)
{
  const std::uint64_t fileBytes = InputFile(path).GetSize();
  if (!options.Raw)
  {
    throw std::runtime_error("cannot read " + path +
                             ": it has no header; --raw 1024x1024x800:uint16 says what it holds");
  }
  const RawLayout & raw = *options.Raw;
  PlainLayout       layout;
  layout.Description = Describe(raw);
  const std::uint64_t voxels = layout.Description.GetBytes();
  if (fileBytes < raw.HeaderBytes || fileBytes - raw.HeaderBytes != voxels)
  {
    throw std::runtime_error("cannot read " + path + ": it has " + std::to_string(fileBytes) +
                             " bytes, but --raw says " + std::to_string(raw.HeaderBytes) + " + " +
                             std::to_string(voxels));
  }
  ApplyOverrides(layout.Description, options, warn, false);
  layout.Sections = { { path, raw.HeaderBytes, voxels } };
  layout.IsBigEndian = raw.IsBigEndian;
  return std::make_unique<PlainReader>(path, layout);
}
