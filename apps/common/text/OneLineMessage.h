// SPDX-License-Identifier: Apache-2.0
#ifndef OneLineMessage_h
#define OneLineMessage_h

#include <regex>
#include <string>

/** An error message in one line, without ITK's own prefix. */
inline std::string
MakeOneLine(const std::string & message)
{
  const std::string text = std::regex_replace(message, std::regex("ITK ERROR: \\w+\\(0x[0-9a-f]+\\): "), "");
  const std::string line = std::regex_replace(text, std::regex("\\s+"), " ");
  const auto        last = line.find_last_not_of(' ');
  return last == std::string::npos ? "unknown error" : line.substr(line.front() == ' ' ? 1 : 0, last + 1);
}

#endif
