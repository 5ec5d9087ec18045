// SPDX-License-Identifier: Apache-2.0
#include "pieces/AgreementText.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace
{
PieceAgreement
Read(std::istream && file)
{
  PieceAgreement agreement;
  for (std::string line; std::getline(file, line);)
  {
    const auto separator = line.find(": ");
    if (separator != std::string::npos)
    {
      agreement.emplace_back(line.substr(0, separator), line.substr(separator + 2));
    }
  }
  return agreement;
}
} // namespace

std::string
Compose(const PieceAgreement & agreement)
{
  std::string text;
  for (const auto & [key, value] : agreement)
  {
    text += key + ": " + MakeOneWord(value) + "\n";
  }
  return text;
}

PieceAgreement
ParseAgreement(const std::string & text)
{
  return Read(std::istringstream(text));
}

PieceAgreement
ReadAgreement(const std::filesystem::path & file)
{
  return Read(std::ifstream(file));
}

std::string
MakeOneWord(std::string text)
{
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string
Find(const PieceAgreement & agreement, const std::string & key)
{
  const auto found = std::find_if(agreement.begin(), agreement.end(), [&](const auto & e) { return e.first == key; });
  return found == agreement.end() ? "" : found->second;
}
