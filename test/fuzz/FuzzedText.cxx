// SPDX-License-Identifier: Apache-2.0
#include "FuzzedFiles.h"

#include "text/TextNumbers.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

using itk::Subdivision::ElementType;

namespace
{
constexpr std::size_t LongestWord = 400;

template <typename T>
T
ReadReal(const char * const text, char ** const end)
{
  return std::is_same_v<T, float> ? static_cast<T>(std::strtof(text, end)) : static_cast<T>(std::strtod(text, end));
}

/** \param number its value, if it is one */
template <typename T>
bool
IsRealNumber(const std::string & word, T & number)
{
  char * end = nullptr;
  number = ReadReal<T>(word.c_str(), &end);
  return end == word.c_str() + word.size() && end != word.c_str();
}

template <typename T>
bool
IsWholeNumber(const std::string & word, T & number)
{
  const std::size_t sign = word[0] == '+' || (word[0] == '-' && std::is_signed_v<T>) ? 1 : 0;
  if (word.size() > sign && word.find_first_not_of("0123456789", sign) == std::string::npos)
  {
    using Wide = std::conditional_t<std::is_signed_v<T>, long long, unsigned long long>;
    errno = 0;
    const Wide wide = std::is_signed_v<T> ? static_cast<Wide>(std::strtoll(word.c_str(), nullptr, 10))
                                          : static_cast<Wide>(std::strtoull(word.c_str(), nullptr, 10));
    number = static_cast<T>(wide);
    return errno == 0 && wide >= std::numeric_limits<T>::lowest() && wide <= std::numeric_limits<T>::max();
  }
  // Written as a real number; beyond 2 to the 53rd power, the nearest one may be another one.
  double real = 0.0;
  errno = 0;
  const bool fits = word.find_first_not_of("+-.0123456789eE") == std::string::npos && IsRealNumber(word, real) &&
                    errno == 0 && std::abs(real) < std::ldexp(1.0, 53) && std::floor(real) == real &&
                    real >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
                    real <= static_cast<double>(std::numeric_limits<T>::max());
  number = fits ? static_cast<T>(real) : T{};
  return fits;
}

std::vector<std::string>
Split(const std::string & text, const std::string & blanks)
{
  std::vector<std::string> words(1);
  for (const char c : text)
  {
    if (blanks.find(c) == std::string::npos)
    {
      words.back() += c;
    }
    else if (!words.back().empty())
    {
      words.emplace_back();
    }
  }
  if (words.back().empty())
  {
    words.pop_back();
  }
  return words;
}

/** What comes of a text. */
struct Outcome
{
  std::vector<char> Voxels;
  std::string       Rest; // the first word after them
  std::string       Error;
};

/** \param parts lengths of the parts that the text is handed over in, again and again */
Outcome
Read(const std::string &                text,
     const ElementType                  type,
     const std::size_t                  count,
     const std::string &                separators,
     const std::array<std::size_t, 4> & parts)
{
  Outcome outcome;
  outcome.Voxels.resize(count * itk::Subdivision::SizeOf(type));
  try
  {
    TextNumbers numbers("text", type, count, outcome.Voxels.data(), separators);
    std::size_t number = 0;
    for (std::size_t place = 0; place < text.size(); place += parts[number++ % parts.size()])
    {
      const std::size_t       length = std::min(parts[number % parts.size()], text.size() - place);
      const std::vector<char> part(text.data() + place, text.data() + place + length); // no byte beyond it
      numbers.Add({ part.data(), part.size() });
    }
    outcome.Rest = numbers.Finish().substr(0, LongestWord);
  }
  catch (const std::runtime_error & error)
  {
    outcome.Error = error.what();
  }
  return outcome;
}
} // namespace

FuzzedWord
ReadFuzzedWord(const std::string & word, const ElementType type)
{
  FuzzedWord result;
  if (word.size() > LongestWord)
  {
    return result;
  }
  return itk::Subdivision::WithElementType(type, [&](auto tag) {
    using T = typename decltype(tag)::Type;
    T number{};
    if constexpr (std::is_floating_point_v<T>)
    {
      result.IsNumber = IsRealNumber(word, number);
      result.IsOpen = result.IsNumber && word.find_first_not_of("+-.0123456789eE") != std::string::npos;
      result.IsNumber = result.IsNumber && (result.IsOpen || std::isfinite(number));
    }
    else
    {
      result.IsNumber = IsWholeNumber(word, number);
    }
    result.Bytes.assign(reinterpret_cast<const char *>(&number), sizeof(number));
    return result;
  });
}

bool
AreBytesOf(const FuzzedWord & word, const ElementType type, const char * const bytes)
{
  return itk::Subdivision::WithElementType(type, [&](auto tag) {
    typename decltype(tag)::Type a{};
    typename decltype(tag)::Type b{};
    std::memcpy(&a, word.Bytes.data(), sizeof(a));
    std::memcpy(&b, bytes, sizeof(b));
    return word.IsNumber && (std::memcmp(&a, &b, sizeof(a)) == 0 || (a != a && b != b));
  });
}

ElementType
ChooseElementType(FuzzBytes & bytes)
{
  return static_cast<ElementType>(bytes.Below(itk::Subdivision::NumberOfElementTypes));
}

/** The numbers are those of the words, and do not depend on where the text is parted. */
void
FuzzTextNumbers(FuzzBytes & bytes)
{
  const ElementType          type = ChooseElementType(bytes);
  const std::size_t          count = bytes.Below(16);
  const std::string          separators = bytes.Below(2) == 0 ? "" : ",";
  std::array<std::size_t, 4> parts{};
  for (std::size_t & part : parts)
  {
    part = 1 + bytes.Below(64);
  }
  const std::string text = bytes.Rest();
  const Outcome     outcome = Read(text, type, count, separators, parts);
  const Outcome     whole = Read(text, type, count, separators, { text.size() + 1, 1, 1, 1 });
  FuzzExpect(outcome.Error == whole.Error && outcome.Rest == whole.Rest, "the parts of a text decide what it is");
  FuzzExpect(!outcome.Error.empty() || outcome.Voxels == whole.Voxels, "the parts of a text decide its numbers");

  const auto  words = Split(text, " \t\r\n\v\f" + separators);
  bool        isOpen = false;
  bool        isRight = words.size() >= count;
  std::size_t number = 0;
  for (; number < std::min(count, words.size()); ++number)
  {
    const FuzzedWord word = ReadFuzzedWord(words[number], type);
    isOpen = isOpen || word.IsOpen;
    isRight = isRight && word.IsNumber;
    FuzzExpect(!outcome.Error.empty() ||
                 AreBytesOf(word, type, outcome.Voxels.data() + number * itk::Subdivision::SizeOf(type)),
               "a text has another number than the word '" + words[number] + "'");
  }
  FuzzExpect(isOpen || outcome.Error.empty() == isRight, "a text that is right is refused, or the other way round");
  FuzzExpect(!outcome.Error.empty() ||
               outcome.Rest == (words.size() > count ? words[count].substr(0, LongestWord) : std::string()),
             "another word than the one after the numbers");
}
