// SPDX-License-Identifier: Apache-2.0
#include "text/TextNumbers.h"
#include "text/HeaderText.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

using itk::Subdivision::ElementType;

namespace
{
constexpr std::size_t LongestWord = 400; // the digits of the largest number, written out

template <typename T>
bool
ParseWhole(const char * first, const char * last, T & number)
{
  const auto result = std::from_chars(first, last, number);
  return result.ec == std::errc() && result.ptr == last;
}

/** Whether a real number that is out of range is too small, not too large, by the power of ten of its first digit. */
bool
IsTooSmall(const char * first, const char * last)
{
  const std::string_view text(first, static_cast<std::size_t>(last - first));
  const auto             end = static_cast<std::int64_t>(std::min(text.find_first_of("eE"), text.size()));
  const auto             point = std::min(static_cast<std::int64_t>(std::min(text.find('.'), text.size())), end);
  const auto             digit = static_cast<std::int64_t>(text.find_first_of("123456789"));
  const std::string_view power = text.substr(std::min(static_cast<std::size_t>(end) + 1, text.size()));
  std::int64_t           exponent = 0;
  const bool             isNegative = !power.empty() && power[0] == '-';
  const std::size_t      sign = !power.empty() && power[0] == '+' ? 1 : 0;
  const auto             result = std::from_chars(power.data() + sign, power.data() + power.size(), exponent);
  return result.ec == std::errc::result_out_of_range ? isNegative : exponent < digit - point;
}

/** A real number nearest to the text; one too small for its type is 0. */
template <typename T>
bool
ParseRounded(const char * first, const char * last, T & number)
{
  const auto result = std::from_chars(first, last, number);
  if (result.ptr == last && result.ec == std::errc::result_out_of_range && IsTooSmall(first, last))
  {
    number = *first == '-' ? -T{ 0 } : T{ 0 };
    return true;
  }
  return result.ptr == last && result.ec == std::errc();
}

template <typename T>
bool
ParseNumber(const char * first, const char * last, T & number)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return ParseRounded(first, last, number);
  }
  else
  {
    double real = 0;
    if (ParseWhole(first, last, number))
    {
      return true;
    }
    constexpr double exact = 9007199254740992.0; // below it, no other integer has the same double
    const bool       isInteger = ParseWhole(first, last, real) && std::abs(real) < exact && std::trunc(real) == real;
    const bool       fits = isInteger && real >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
                      real <= static_cast<double>(std::numeric_limits<T>::max());
    number = fits ? static_cast<T>(real) : T{};
    return fits;
  }
}
} // namespace

TextNumbers::TextNumbers(std::string         path,
                         const ElementType   type,
                         const std::uint64_t count,
                         void *              out,
                         std::string         separators)
  : m_Path(std::move(path))
  , m_Type(type)
  , m_Count(count)
  , m_Blanks(" \t\r\n\v\f" + std::move(separators))
  , m_Next(static_cast<char *>(out))
{}

bool
TextNumbers::TryToParse(void * to) const
{
  const bool         hasPlus = m_Word.size() > 1 && m_Word[0] == '+' && m_Word[1] != '-';
  const char * const first = m_Word.data() + (hasPlus ? 1 : 0);
  return itk::Subdivision::WithElementType(m_Type, [&](auto tag) {
    typename decltype(tag)::Type number{};
    const bool                   isNumber = ParseNumber(first, m_Word.data() + m_Word.size(), number);
    std::memcpy(to, &number, sizeof(number));
    return isNumber && m_Word.size() <= LongestWord;
  });
}

void
TextNumbers::TakeWord()
{
  if (m_Done == m_Count)
  {
    m_Rest = m_Rest.empty() ? m_Word : m_Rest;
  }
  else if (this->TryToParse(m_Next))
  {
    m_Next += itk::Subdivision::SizeOf(m_Type);
    ++m_Done;
  }
  else
  {
    constexpr std::size_t shown = 40;
    FailToRead(m_Path,
               "number " + std::to_string(m_Done + 1) + " of its voxels is '" + m_Word.substr(0, shown) +
                 "', which voxels of the type " + itk::Subdivision::GetName(m_Type) + " cannot be");
  }
  m_Word.clear();
}

void
TextNumbers::Add(const std::string_view part)
{
  for (std::size_t start = 0; start < part.size() && m_Rest.empty();)
  {
    const std::size_t end = std::min(part.find_first_of(m_Blanks, start), part.size());
    m_Word += part.substr(start, std::min(end - start, LongestWord + 1));
    if ((end < part.size() && !m_Word.empty()) || m_Word.size() > LongestWord)
    {
      this->TakeWord();
    }
    start = end + 1;
  }
}

std::string
TextNumbers::Finish()
{
  if (!m_Word.empty())
  {
    this->TakeWord();
  }
  if (m_Done < m_Count)
  {
    FailToRead(m_Path,
               "it is truncated, with " + std::to_string(m_Done) + " of " + std::to_string(m_Count) + " numbers");
  }
  return m_Rest;
}
