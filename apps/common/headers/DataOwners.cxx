// SPDX-License-Identifier: Apache-2.0
#include "headers/DataOwners.h"
#include "system/files/InputFile.h"
#include "text/HeaderText.h"

#include <stdexcept>
#include <vector>

namespace fs = std::filesystem;

namespace
{
/** The value of the field that names the data file, and the lines after it, which may be a list. */
std::vector<std::string>
ReadDataLines(const fs::path & header)
{
  std::vector<std::string> lines;
  const std::string        text = InputFile(header.string()).ReadTextAt(0, 1 << 20) + "\n";
  for (std::size_t start = 0, end = 0; (end = text.find('\n', start)) != std::string::npos; start = end + 1)
  {
    const std::string line = text.substr(start, end - start);
    if (!lines.empty())
    {
      lines.push_back(Trim(line));
      continue;
    }
    const auto        separator = line.find_first_of("=:");
    const std::string key = separator == std::string::npos ? "" : ToLower(Trim(line.substr(0, separator)));
    if (key == "elementdatafile" || key == "data file" || key == "datafile")
    {
      lines.push_back(Trim(line.substr(separator + 1)));
      if (lines.front().rfind("LIST", 0) != 0)
      {
        break;
      }
    }
  }
  return lines;
}

bool
IsSameFile(const fs::path & a, const fs::path & b)
{
  std::error_code error;
  return fs::weakly_canonical(a, error) == fs::weakly_canonical(b, error) && !error;
}

/** Whether a pattern such as slice%03d.raw can make a name. */
bool
Matches(const fs::path & pattern, const fs::path & data)
{
  const std::string word = pattern.filename().string();
  const std::string name = data.filename().string();
  const std::size_t percent = word.find('%');
  const std::size_t end = percent == std::string::npos ? percent : word.find_first_not_of("0123456789", percent + 1);
  if (end == std::string::npos)
  {
    return false;
  }
  const std::string suffix = word.substr(end + 1);
  const std::size_t rest = percent + suffix.size();
  return IsSameFile(pattern.parent_path(), data.parent_path()) && name.size() >= rest &&
         name.compare(0, percent, word, 0, percent) == 0 &&
         name.compare(name.size() - suffix.size(), suffix.size(), suffix) == 0 &&
         name.substr(percent, name.size() - rest).find_first_not_of(" 0123456789") == std::string::npos;
}

bool
Names(const fs::path & header, const fs::path & data)
{
  const std::vector<std::string> lines = ReadDataLines(header);
  const fs::path                 folder = header.parent_path();
  if (lines.empty() || lines.front().empty())
  {
    return false;
  }
  const bool isList = lines.front().rfind("LIST", 0) == 0;
  for (std::size_t i = isList ? 1 : 0; i < lines.size(); ++i)
  {
    if (!lines[i].empty() && IsSameFile(folder / lines[i], data))
    {
      return true;
    }
  }
  return !isList && Matches(folder / SplitWords(lines.front()).front(), data);
}

bool
MayBeHeader(const fs::path & path)
{
  const std::string ending = ToLower(path.extension().string());
  return ending == ".mhd" || ending == ".nhdr" || ending == ".mha" || ending == ".nrrd";
}
} // namespace

std::string
ReadDataName(const fs::path & header)
{
  std::error_code error;
  if (!fs::is_regular_file(header, error))
  {
    return {};
  }
  const std::vector<std::string> lines = ReadDataLines(header);
  const std::string              name = lines.empty() ? "" : lines.front();
  return name.rfind("./", 0) == 0 ? name.substr(2) : name;
}

std::vector<std::string>
ListDataFiles(const std::string & header)
{
  std::vector<std::string> names = ReadDataLines(header);
  if (names.empty() || ToLower(names.front()) == "local")
  {
    return {};
  }
  const std::vector<std::string> words = SplitWords(names.front());
  if (names.front().rfind("LIST", 0) == 0)
  {
    names.erase(names.begin());
  }
  else if (words.size() >= 3 && words[0].find('%') != std::string::npos)
  {
    const auto parse = [&](std::size_t i) { return ParseInteger(header, "data file", words[i]); };
    names = ExpandPattern(header, words[0], parse(1), parse(2), words.size() > 3 ? parse(3) : 1);
  }
  for (std::string & name : names)
  {
    name = (fs::path(header).parent_path() / name).string();
  }
  return names;
}

std::optional<fs::path>
FindOtherOwner(const fs::path & data, const fs::path & header)
{
  std::error_code error;
  for (const fs::directory_entry & entry : fs::directory_iterator(data.parent_path(), error))
  {
    if (!MayBeHeader(entry.path()) || !entry.is_regular_file(error) || fs::equivalent(entry.path(), header, error))
    {
      continue;
    }
    try
    {
      if (Names(entry.path(), data))
      {
        return entry.path();
      }
    }
    catch (const std::runtime_error &)
    {
      return entry.path();
    }
  }
  return std::nullopt;
}
