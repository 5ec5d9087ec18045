// SPDX-License-Identifier: Apache-2.0
#include "text/HeaderText.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

void
FailToRead(const std::string & path, const std::string & reason)
{
  throw std::runtime_error("cannot read " + path + ": " + reason);
}

std::string
Trim(const std::string & text)
{
  const char * const blanks = " \t\r\n";
  const auto         first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::string
ToLower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool
HasEnding(const std::string & name, const std::string & ending)
{
  return name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

std::vector<std::string>
SplitWords(const std::string & text)
{
  std::istringstream       stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
  {
    words.push_back(word);
  }
  return words;
}

namespace
{
template <typename TNumber>
TNumber
Parse(const std::string & path, const std::string & field, const std::string & word)
{
  const char * const first = word.data() + (word.size() > 1 && word[0] == '+' && word[1] != '-' ? 1 : 0);
  const char * const last = word.data() + word.size();
  TNumber            number{};
  const auto         result = std::from_chars(first, last, number);
  if (result.ec != std::errc() || result.ptr != last)
  {
    FailToRead(path, "the field '" + field + "' of its header has '" + word + "' where a number is due");
  }
  return number;
}

void
CheckCount(const std::string & path, const std::string & field, std::size_t found, std::size_t due)
{
  if (found != due)
  {
    FailToRead(path,
               "the field '" + field + "' of its header has " + std::to_string(found) + " values instead of " +
                 std::to_string(due));
  }
}
} // namespace

double
ParseReal(const std::string & path, const std::string & field, const std::string & word)
{
  return Parse<double>(path, field, word);
}

std::int64_t
ParseInteger(const std::string & path, const std::string & field, const std::string & word)
{
  return Parse<std::int64_t>(path, field, word);
}

std::vector<double>
ParseReals(const std::string & path, const std::string & field, const std::string & text, std::size_t count)
{
  const std::vector<std::string> words = SplitWords(text);
  CheckCount(path, field, words.size(), count);
  std::vector<double> numbers;
  for (const std::string & word : words)
  {
    numbers.push_back(ParseReal(path, field, word));
  }
  return numbers;
}

std::vector<std::uint64_t>
ParseSizes(const std::string & path, const std::string & field, const std::string & text, std::size_t count)
{
  const std::vector<std::string> words = SplitWords(text);
  CheckCount(path, field, words.size(), count);
  std::vector<std::uint64_t> sizes;
  for (const std::string & word : words)
  {
    const std::int64_t size = ParseInteger(path, field, word);
    if (size < 1)
    {
      FailToRead(path, "the field '" + field + "' of its header has the size " + word);
    }
    sizes.push_back(static_cast<std::uint64_t>(size));
  }
  return sizes;
}

std::string
FormatReal(double value)
{
  char       text[64];
  const auto result = std::to_chars(text, text + sizeof(text), value == 0.0 ? 0.0 : value); // no "-0"
  return std::string(text, result.ptr);
}

std::string
JoinReals(const std::vector<double> & values)
{
  std::string text;
  for (const double value : values)
  {
    text += (text.empty() ? "" : " ") + FormatReal(value);
  }
  return text;
}

std::string
JoinSizes(const std::vector<std::uint64_t> & values)
{
  std::string text;
  for (const std::uint64_t value : values)
  {
    text += (text.empty() ? "" : " ") + std::to_string(value);
  }
  return text;
}

std::vector<std::string>
ExpandPattern(const std::string & path,
              const std::string & pattern,
              std::int64_t        first,
              std::int64_t        last,
              std::int64_t        step)
{
  const auto start = pattern.find('%');
  const auto end = start == std::string::npos ? start : pattern.find_first_not_of("0123456789", start + 1);
  const bool isInteger =
    end != std::string::npos && (pattern[end] == 'd' || pattern[end] == 'u' || pattern[end] == 'i');
  if (!isInteger || end - start > 4 || pattern.find('%', end) != std::string::npos)
  {
    FailToRead(path, "the pattern '" + pattern + "' of its data files is not one of an integer");
  }
  constexpr std::int64_t limit = 1000000;
  if (step == 0 || std::abs(static_cast<double>(first)) > 1e15 || std::abs(static_cast<double>(last)) > 1e15 ||
      std::abs(static_cast<double>(step)) > 1e15 || (last - first) / step > limit)
  {
    FailToRead(path, "the numbers of its data files are not a range");
  }
  const std::string digits = pattern.substr(start + 1, end - start - 1);
  const std::size_t width = digits.empty() ? 0 : std::stoul(digits);
  const char        fill = !digits.empty() && digits[0] == '0' ? '0' : ' ';

  std::vector<std::string> names;
  for (std::int64_t number = first; step > 0 ? number <= last : number >= last; number += step)
  {
    std::string text = std::to_string(number);
    text.insert(0, width > text.size() ? width - text.size() : 0, fill);
    names.push_back(pattern.substr(0, start) + text + pattern.substr(end + 1));
  }
  return names;
}
