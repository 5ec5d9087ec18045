// SPDX-License-Identifier: Apache-2.0
#include "system/LibraryMessages.h"
#include "text/OneLineMessage.h"

#include <algorithm>
#include <iostream>
#include <regex>

#include <unistd.h>

std::FILE *
GetTerminal()
{
  static std::FILE * const terminal = [] {
    std::FILE * const file = fdopen(dup(STDERR_FILENO), "w");
    if (file == nullptr)
    {
      return stderr;
    }
    setvbuf(file, nullptr, _IOLBF, BUFSIZ);
    return file;
  }();
  return terminal;
}

namespace
{
std::FILE *
GetFile()
{
  static std::FILE * const file = std::tmpfile();
  return file;
}

/** What stands in the file from a place on. */
std::string
ReadFrom(std::size_t start)
{
  std::string text;
  char        bytes[4096];
  while (GetFile() != nullptr)
  {
    const auto count = pread(fileno(GetFile()), bytes, sizeof(bytes), static_cast<off_t>(start + text.size()));
    if (count <= 0)
    {
      break;
    }
    text.append(bytes, static_cast<std::size_t>(count));
  }
  return text;
}

std::size_t
GetEnd()
{
  const off_t end = GetFile() == nullptr ? 0 : lseek(fileno(GetFile()), 0, SEEK_END);
  return end < 0 ? 0 : static_cast<std::size_t>(end);
}

/** A paragraph without the line of ITK's and GDCM's that tells the place in the source code. */
std::string
RemovePlace(const std::string & paragraph)
{
  static const std::regex place("^\\s*\\w+: In [^\n]*\\bline \\d+[^\n]*\n(\\w+ \\(0x[0-9a-f]+\\): )?");
  return std::regex_replace(paragraph, place, "");
}
} // namespace

LibraryMessages::LibraryMessages()
  : m_Start(GetEnd())
  , m_Errors(dup(STDERR_FILENO))
  , m_Output(std::cout.rdbuf(std::cerr.rdbuf()))
{
  Prepare();
  if (GetFile() != nullptr)
  {
    dup2(fileno(GetFile()), STDERR_FILENO);
  }
}

LibraryMessages::~LibraryMessages()
{
  std::cout.rdbuf(m_Output);
  std::fflush(stderr);
  dup2(m_Errors, STDERR_FILENO);
  close(m_Errors);
}

std::string
LibraryMessages::GetText() const
{
  return ReadFrom(m_Start);
}

void
LibraryMessages::Prepare()
{
  GetTerminal();
  GetFile();
}

std::string
LibraryMessages::GetWholeText()
{
  return ReadFrom(0);
}

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
