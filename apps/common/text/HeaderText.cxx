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

/** The volume that the unit vectors of the axes span. */
double
GetDeterminant(std::vector<std::vector<double>> rows)
{
  double determinant = 1.0;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const auto pivot =
      std::max_element(rows.begin() + static_cast<std::ptrdiff_t>(i), rows.end(), [i](const auto & a, const auto & b) {
        return std::abs(a[i]) < std::abs(b[i]);
      });
    std::swap(rows[i], *pivot);
    determinant *= rows[i][i];
    for (std::size_t k = i + 1; k < rows.size() && rows[i][i] != 0.0; ++k)
    {
      const double factor = rows[k][i] / rows[i][i];
      for (std::size_t j = i; j < rows.size(); ++j)
      {
        rows[k][j] -= factor * rows[i][j];
      }
    }
  }
  return determinant;
}

void
CheckSize(const std::string & path, const ImageDescription & description)
{
  const std::size_t axes = description.Grid.Size.size();
  if (axes < 1 || axes > 4)
  {
    FailToRead(path, "it has " + std::to_string(axes) + " axes; up to 4 are supported");
  }
  // In real numbers, since whole numbers overflow silently. The output has 16 times as many bytes in 4D, in double 128
  // times, and a few copies of that still fit a 64-bit number.
  double bytes = static_cast<double>(description.GetVoxelBytes());
  for (const std::uint64_t size : description.Grid.Size)
  {
    bytes *= static_cast<double>(size);
  }
  if (bytes == 0.0)
  {
    FailToRead(path, "the image is empty");
  }
  if (bytes > 1e16)
  {
    FailToRead(path, "an image that large cannot be processed");
  }
}

/** Makes a spacing positive and a direction a unit vector, unless it already is one to within a header's digits. */
void
Normalise(double & spacing, std::vector<double> & direction)
{
  double square = 0.0;
  for (const double number : direction)
  {
    square += number * number;
  }
  double scale = std::abs(std::sqrt(square) - 1.0) > 1e-4 ? std::sqrt(square) : 1.0;
  scale = spacing < 0.0 ? -scale : scale;
  spacing *= scale;
  for (double & number : direction)
  {
    number /= scale;
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

void
CheckDescription(const std::string & path, ImageDescription & description)
{
  CheckSize(path, description);
  ImageGrid & grid = description.Grid;
  for (std::size_t axis = 0; axis < grid.Size.size(); ++axis)
  {
    Normalise(grid.Spacing[axis], grid.Directions[axis]);
    if (!(grid.Spacing[axis] > 0.0) || !std::isfinite(grid.Spacing[axis]))
    {
      FailToRead(path, "the spacing of its axis " + std::to_string(axis) + " is not a positive number");
    }
    if (!std::isfinite(grid.Origin[axis]))
    {
      FailToRead(path, "its origin is not finite");
    }
  }
  if (!(std::abs(GetDeterminant(grid.Directions)) > 1e-6))
  {
    FailToRead(path, "the directions of its axes lie in one plane");
  }
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
