// SPDX-License-Identifier: Apache-2.0
#include "headers/MetaFields.h"
#include "text/HeaderText.h"

#include <algorithm>
#include <set>

namespace
{
const std::set<std::string> Fields = {
  "ObjectType",
  "ObjectSubType",
  "NDims",
  "Name",
  "ID",
  "ParentID",
  "Comment",
  "AcquisitionDate",
  "Color",
  "CompressedData",
  "CompressedDataSize",
  "CompressionLevel",
  "BinaryData",
  "ElementByteOrderMSB",
  "BinaryDataByteOrderMSB",
  "TransformMatrix",
  "Rotation",
  "Orientation",
  "Offset",
  "Origin",
  "Position",
  "CenterOfRotation",
  "DistanceUnits",
  "AnatomicalOrientation",
  "ElementSpacing",
  "ElementSize",
  "DimSize",
  "HeaderSize",
  "Modality",
  "ImagePosition",
  "SequenceID",
  "ElementMin",
  "ElementMax",
  "ElementNumberOfChannels",
  "ElementToIntensityFunctionSlope",
  "ElementToIntensityFunctionOffset",
  "ElementNBits",
  "ElementType",
  "ElementDataFile",
  "FormTypeName",
  "FileFormatVersion",
  "ObjectTypeName",
};
} // namespace

MetaFields::MetaFields(const InputFile & file)
  : m_Path(file.GetPath())
{
  constexpr std::uint64_t longest = 1 << 24;
  const std::string       text = file.ReadTextAt(0, std::min<std::uint64_t>(longest, 1 << 16));
  if (!this->Parse(text) && !(text.size() == 1 << 16 && this->Parse(file.ReadTextAt(0, longest))))
  {
    FailToRead(m_Path, "its header does not end with the field 'ElementDataFile'");
  }
}

std::optional<std::string>
MetaFields::Find(const std::vector<std::string> & names) const
{
  std::optional<std::string> value;
  for (const std::string & name : names)
  {
    const auto found = m_Values.find(name);
    if (found != m_Values.end() && value && *value != found->second)
    {
      FailToRead(m_Path, "the field '" + name + "' of its header contradicts another one");
    }
    value = found != m_Values.end() ? found->second : value;
  }
  return value;
}

std::string
MetaFields::Get(const std::string & name) const
{
  const auto value = this->Find({ name });
  if (!value)
  {
    FailToRead(m_Path, "its header lacks the field '" + name + "'");
  }
  return *value;
}

bool
MetaFields::GetFlag(const std::vector<std::string> & names, bool otherwise) const
{
  const std::string value = this->Find(names).value_or(otherwise ? "True" : "False");
  const std::string letter = ToLower(value).substr(0, 1);
  if (letter != "t" && letter != "f" && letter != "1" && letter != "0")
  {
    FailToRead(m_Path, "the field '" + names.front() + "' of its header is neither True nor False");
  }
  return letter == "t" || letter == "1";
}

bool
MetaFields::Parse(const std::string & text)
{
  m_Values.clear();
  for (std::size_t start = 0, end = 0; (end = text.find('\n', start)) != std::string::npos; start = end + 1)
  {
    const std::string line = Trim(text.substr(start, end - start));
    if (line.empty())
    {
      continue;
    }
    const auto separator = line.find_first_of("=:");
    if (separator == std::string::npos)
    {
      FailToRead(m_Path, "its header has a line without '='");
    }
    const std::string key = Trim(line.substr(0, separator));
    if (!m_Values.emplace(key, Trim(line.substr(separator + 1))).second)
    {
      FailToRead(m_Path, "its header has the field '" + key + "' twice");
    }
    if (key == "ElementDataFile")
    {
      End = end + 1;
      return true;
    }
  }
  return false;
}

bool
IsMetaField(const std::string & key)
{
  return Fields.count(key) != 0;
}
