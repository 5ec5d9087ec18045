// SPDX-License-Identifier: Apache-2.0
#ifndef AgreementText_h
#define AgreementText_h

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

/** What all pieces of an output must agree on, in words and in the order of messages: "scheme", "linear". */
using PieceAgreement = std::vector<std::pair<std::string, std::string>>;

/** As it is written: a line for each. */
std::string
Compose(const PieceAgreement & agreement);

PieceAgreement
ParseAgreement(const std::string & text);

/** Empty if the file is not there. */
PieceAgreement
ReadAgreement(const std::filesystem::path & file);

/** A line breaks no agreement. */
std::string
MakeOneWord(std::string text);

/** Empty if nothing was agreed on. */
std::string
Find(const PieceAgreement & agreement, const std::string & key);

#endif
