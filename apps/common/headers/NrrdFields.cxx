// SPDX-License-Identifier: Apache-2.0
#include "headers/NrrdFields.h"
#include "text/HeaderText.h"

#include <algorithm>
#include <set>

namespace
{
// Names as NormaliseNrrdName() makes them.
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
} // namespace

NrrdFields::NrrdFields(const InputFile & file)
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
NrrdFields::Find(const std::string & name) const
{
  const auto found = m_Values.find(name);
  return found == m_Values.end() ? std::nullopt : std::optional<std::string>(found->second);
}

std::string
NrrdFields::Get(const std::string & name) const
{
  const auto value = this->Find(name);
  if (!value)
  {
    FailToRead(m_Path, "its header lacks the field '" + name + "'");
  }
  return *value;
}

bool
NrrdFields::Parse(const std::string & text, bool isWholeFile)
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
NrrdFields::ParseLine(const std::string & line, bool isFirst)
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
  const std::string name = NormaliseNrrdName(line.substr(0, colon));
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
NrrdFields::IsList() const
{
  const auto found = m_Values.find("datafile");
  return found != m_Values.end() && found->second.compare(0, 4, "LIST") == 0;
}

bool
NrrdFields::ParseNames(const std::string & text, bool isWholeFile)
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

std::string
NormaliseNrrdName(const std::string & name)
{
  std::string normal = ToLower(name);
  normal.erase(std::remove(normal.begin(), normal.end(), ' '), normal.end());
  return normal;
}

bool
IsNrrdField(const std::string & name)
{
  return Fields.count(NormaliseNrrdName(name)) != 0;
}
