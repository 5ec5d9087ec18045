// SPDX-License-Identifier: Apache-2.0
#include "text/LibraryWarnings.h"
#include "text/OneLineMessage.h"

#include <algorithm>
#include <regex>
#include <sstream>

namespace
{
/** A paragraph without the line of ITK's and GDCM's that tells the place in the source code. */
std::string
RemovePlace(const std::string & paragraph)
{
  static const std::regex place("^\\s*\\w+: In [^\n]*\\bline \\d+[^\n]*\n(\\w+ \\(0x[0-9a-f]+\\): )?");
  return std::regex_replace(paragraph, place, "");
}
} // namespace

std::vector<std::string>
FindLibraryWarnings(const std::string & all)
{
  constexpr std::size_t    longest = 1 << 16; // regular expressions need a stack as deep as the text is long
  const std::string        text = all.substr(0, longest);
  constexpr std::size_t    most = 5;
  static const std::regex  gap("\n[ \t]*\n|\n(?=[^\n]*[Ww][Aa][Rr][Nn][Ii][Nn][Gg])");
  static const std::regex  warning("\\bwarning\\b", std::regex::icase);
  std::vector<std::string> found;
  for (std::sregex_token_iterator i(text.begin(), text.end(), gap, -1), end; i != end && found.size() < most; ++i)
  {
    const std::string paragraph = *i;
    const std::string line = MakeOneLine(RemovePlace(paragraph));
    if (std::regex_search(paragraph, warning) && std::find(found.begin(), found.end(), line) == found.end())
    {
      found.push_back(line);
    }
  }
  return found;
}

std::string
RemoveSourceLines(const std::string & text)
{
  static const std::regex place("\\.(c|cc|cpp|cxx|txx|h|hpp|hxx)(:|, line )[0-9]");
  std::istringstream      lines(text);
  std::string             left;
  for (std::string line; std::getline(lines, line);)
  {
    left += std::regex_search(line, place) ? "" : line + '\n';
  }
  return left;
}
