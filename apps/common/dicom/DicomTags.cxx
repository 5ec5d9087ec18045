// SPDX-License-Identifier: Apache-2.0
#include "dicom/DicomTags.h"

#include "gdcmByteValue.h"
#include "gdcmSequenceOfItems.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>

namespace
{
const gdcm::ByteValue *
FindBytes(const gdcm::DataSet & data, const gdcm::Tag & tag)
{
  return data.FindDataElement(tag) ? data.GetDataElement(tag).GetByteValue() : nullptr;
}

std::string
Trim(const std::string & text)
{
  const std::string padding(" \0\t\r\n", 5);
  const auto        first = text.find_first_not_of(padding);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(padding) - first + 1);
}

/** Without control characters, and without letters of a character set that the terminal need not have. */
std::string
MakePrintable(std::string text)
{
  std::replace_if(text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

/** In the "C" locale, whatever the program's. */
double
ParseNumber(const std::string & word, const gdcm::Tag & tag)
{
  const char * const first = word.c_str() + (word.front() == '+' ? 1 : 0);
  const char * const last = word.c_str() + word.size();
  double             number = 0;
  const auto         result = std::from_chars(first, last, number);
  if (result.ec != std::errc() || result.ptr != last || !std::isfinite(number))
  {
    std::ostringstream text;
    text << "'" << word << "' in the DICOM attribute " << tag << " is no number";
    throw std::runtime_error(text.str());
  }
  return number;
}

template <typename T>
std::optional<unsigned int>
GetBinary(const gdcm::DataSet & data, const gdcm::Tag & tag)
{
  const gdcm::ByteValue * const bytes = FindBytes(data, tag);
  if (bytes == nullptr || bytes->GetLength() < sizeof(T))
  {
    return std::nullopt;
  }
  T number;
  std::memcpy(&number, bytes->GetPointer(), sizeof(T));
  return number;
}
} // namespace

std::string
GetDicomText(const gdcm::DataSet & data, const gdcm::Tag & tag)
{
  const gdcm::ByteValue * const bytes = FindBytes(data, tag);
  return bytes == nullptr ? "" : MakePrintable(Trim(std::string(bytes->GetPointer(), bytes->GetLength())));
}

std::vector<double>
GetDicomNumbers(const gdcm::DataSet & data, const gdcm::Tag & tag)
{
  std::vector<double> numbers;
  std::istringstream  text(GetDicomText(data, tag));
  std::string         word;
  while (std::getline(text, word, '\\'))
  {
    word = Trim(word);
    if (!word.empty())
    {
      numbers.push_back(ParseNumber(word, tag));
    }
  }
  return numbers;
}

std::optional<double>
GetDicomNumber(const gdcm::DataSet & data, const gdcm::Tag & tag)
{
  const std::vector<double> numbers = GetDicomNumbers(data, tag);
  return numbers.empty() ? std::nullopt : std::optional<double>(numbers.front());
}

std::optional<unsigned int>
GetDicomShort(const gdcm::DataSet & data, const gdcm::Tag & tag)
{
  return GetBinary<std::uint16_t>(data, tag);
}

std::optional<unsigned int>
GetDicomLong(const gdcm::DataSet & data, const gdcm::Tag & tag)
{
  return GetBinary<std::uint32_t>(data, tag);
}

std::vector<gdcm::DataSet>
GetDicomItems(const gdcm::DataSet & data, const gdcm::Tag & tag)
{
  std::vector<gdcm::DataSet> items;
  if (data.FindDataElement(tag))
  {
    const gdcm::SmartPointer<gdcm::SequenceOfItems> sequence = data.GetDataElement(tag).GetValueAsSQ();
    for (std::size_t i = 1; sequence && i <= sequence->GetNumberOfItems(); ++i)
    {
      items.push_back(sequence->GetItem(i).GetNestedDataSet());
    }
  }
  return items;
}
