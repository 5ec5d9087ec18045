// SPDX-License-Identifier: Apache-2.0
#include "slices/SliceNames.h"
#include "volumes/NumberGaps.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <map>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{
bool
IsDigit(char character)
{
  return character >= '0' && character <= '9';
}

/** A file's name in parts: texts and runs of digits in turns, a text first, without the ending. */
struct SplitName
{
  fs::path                 File;
  std::vector<std::string> Texts;
  std::vector<std::string> Digits; // the run after each text; the last may be empty
  std::uint64_t            Number = 0;
};

[[noreturn]] void
Fail(const fs::path & folder, const std::string & reason)
{
  throw std::runtime_error("cannot read the folder " + folder.string() + ": " + reason);
}

SplitName
Split(const fs::path & file)
{
  SplitName         split{ file, {}, {}, 0 };
  const std::string stem = file.stem().string();
  for (auto next = stem.begin(); next != stem.end() || split.Texts.empty();)
  {
    const auto digits = std::find_if(next, stem.end(), IsDigit);
    const auto end = std::find_if_not(digits, stem.end(), IsDigit);
    split.Texts.emplace_back(next, digits);
    split.Digits.emplace_back(digits, end);
    next = end;
  }
  return split;
}

std::string
FormatOf(const fs::path & file)
{
  static const std::map<std::string, std::string> formats = { { ".tif", "TIFF" }, { ".tiff", "TIFF" },
                                                              { ".png", "PNG" },  { ".bmp", "BMP" },
                                                              { ".jpg", "JPEG" }, { ".jpeg", "JPEG" } };
  std::string                                     ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto found = formats.find(ending);
  return found == formats.end() ? "" : found->second;
}

/** How many numbers a name has. */
std::size_t
CountNumbers(const SplitName & name)
{
  return name.Digits.size() - (name.Digits.back().empty() ? 1 : 0);
}

bool
IsNamedLike(const SplitName & a, const SplitName & b)
{
  return a.Texts == b.Texts && CountNumbers(a) == CountNumbers(b) && FormatOf(a.File) == FormatOf(b.File);
}

/** NAME of NAME0001.tif, NAME_1.tif and NAME (1).tif. */
std::string
GetNameBeforeNumber(const fs::path & file)
{
  std::string name = file.stem().string();
  for (const char * const characters : { ")", "0123456789", " _-.(" })
  {
    name.erase(name.find_last_not_of(characters) + 1);
  }
  return name;
}

/** Takes out a picture that is no slice: where all but one are named alike, and that one lacks their number, as the
 * preview NAME_rec_spr.bmp beside NAME_rec0000.bmp and on. What has their name alone may be the first slice, and stays.
 */
void
TakeOutPreview(const fs::path & folder, std::vector<SplitName> & names, const WarningSink & warn)
{
  for (auto odd = names.begin(); names.size() > 2 && odd != names.end(); ++odd)
  {
    const SplitName & other = odd == names.begin() ? names.back() : names.front();
    const auto        alike =
      std::count_if(names.begin(), names.end(), [&other](const SplitName & name) { return IsNamedLike(name, other); });
    const bool isAlone = static_cast<std::size_t>(alike) + 1 == names.size() && !IsNamedLike(*odd, other);
    const bool mayBeFirst = odd->File.stem().string() == GetNameBeforeNumber(other.File);
    if (isAlone && CountNumbers(*odd) < CountNumbers(other) && !mayBeFirst)
    {
      warn("the picture " + odd->File.filename().string() + " of the folder " + folder.string() +
           " has no number as the slices have: it is left aside");
      names.erase(odd);
      return;
    }
  }
}

std::string
WithoutZeros(const std::string & digits)
{
  const auto first = digits.find_first_not_of('0');
  return first == std::string::npos ? "0" : digits.substr(first);
}

/** The run of digits in which the names differ. */
std::size_t
FindNumber(const fs::path & folder, const std::vector<SplitName> & names)
{
  std::size_t       varying = names.front().Digits.size();
  const SplitName & first = names.front();
  for (const SplitName & name : names)
  {
    if (name.Texts != first.Texts || name.Digits.back().empty() != first.Digits.back().empty())
    {
      Fail(folder,
           "it holds slices of several series, such as " + first.File.filename().string() + " and " +
             name.File.filename().string() + "; put each series into a folder of its own");
    }
    for (std::size_t run = 0; run < first.Digits.size(); ++run)
    {
      if (WithoutZeros(name.Digits[run]) == WithoutZeros(first.Digits[run]))
      {
        continue;
      }
      if (varying < first.Digits.size() && run != varying)
      {
        Fail(folder,
             "its names differ in more than one number, such as " + first.File.filename().string() + " and " +
               name.File.filename().string() + "; put each series into a folder of its own");
      }
      varying = run;
    }
  }
  return varying;
}

/** Sorts by the number and takes care that it is one for each file. */
void
SortByNumber(const fs::path & folder, std::vector<SplitName> & names, std::size_t run)
{
  for (SplitName & name : names)
  {
    const std::string digits = run < name.Digits.size() ? WithoutZeros(name.Digits[run]) : "0";
    const std::string before = run < name.Digits.size() ? name.Texts[run] : "";
    if (digits.size() > 18)
    {
      Fail(folder, "the number of " + name.File.filename().string() + " has more than 18 digits");
    }
    if (before == "-" || (before.size() > 1 && before.compare(before.size() - 2, 2, "_-") == 0))
    {
      Fail(folder, "the number of " + name.File.filename().string() + " may be negative; number the slices from 0");
    }
    name.Number = std::stoull(digits);
  }
  std::sort(names.begin(), names.end(), [](const auto & a, const auto & b) {
    return a.Number != b.Number ? a.Number < b.Number : a.File < b.File;
  });
  const auto twice =
    std::adjacent_find(names.begin(), names.end(), [](const auto & a, const auto & b) { return a.Number == b.Number; });
  if (twice != names.end())
  {
    Fail(folder,
         twice->File.filename().string() + " and " + std::next(twice)->File.filename().string() +
           " have the same number");
  }
}

void
WarnOfGaps(const fs::path & folder, const std::vector<SplitName> & names, const WarningSink & warn)
{
  std::vector<std::int64_t> numbers;
  for (const SplitName & name : names)
  {
    numbers.push_back(static_cast<std::int64_t>(name.Number));
  }
  WarnOfNumberGaps("the folder " + folder.string(), numbers, warn);
}
} // namespace

SliceList
ListSlices(const fs::path & folder, const WarningSink & warn)
{
  std::error_code        error;
  std::vector<SplitName> names;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    const fs::path  file = entry->path();
    std::error_code ignored;
    if (file.filename().string().front() != '.' && !FormatOf(file).empty() && !fs::is_directory(file, ignored))
    {
      names.push_back(Split(file));
    }
  }
  if (error)
  {
    Fail(folder, error.message());
  }
  if (names.empty())
  {
    return {};
  }
  // The messages depend on the names alone, not on the order in which the file system lists them.
  std::sort(names.begin(), names.end(), [](const auto & a, const auto & b) { return a.File < b.File; });
  TakeOutPreview(folder, names, warn);
  SliceList list{ FormatOf(names.front().File), {} };
  for (const SplitName & name : names)
  {
    if (FormatOf(name.File) != list.Format)
    {
      Fail(folder,
           "it holds images of several formats, such as " + names.front().File.filename().string() + " and " +
             name.File.filename().string() + "; put those that are slices of one volume into a folder of their own");
    }
  }
  SortByNumber(folder, names, FindNumber(folder, names));
  WarnOfGaps(folder, names, warn);
  for (const SplitName & name : names)
  {
    list.Files.push_back(name.File);
  }
  return list;
}
