// SPDX-License-Identifier: Apache-2.0
#ifndef HeaderText_h
#define HeaderText_h

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

/** What the headers of several formats have in common. */

/** The header is of a kind that only the format's own library reads. */
struct HeaderNotUnderstood : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** Ends the reading of a file with one sentence. */
[[noreturn]] void
FailToRead(const std::string & path, const std::string & reason);

std::string
Trim(const std::string & text);

std::string
ToLower(std::string text);

bool
HasEnding(const std::string & name, const std::string & ending);

std::vector<std::string>
SplitWords(const std::string & text);

/** Numbers as computers write them, nothing before or after them.
 * \throw std::runtime_error with one sentence on the field and its value */
double
ParseReal(const std::string & path, const std::string & field, const std::string & word);
std::int64_t
ParseInteger(const std::string & path, const std::string & field, const std::string & word);
std::vector<double>
ParseReals(const std::string & path, const std::string & field, const std::string & text, std::size_t count);
std::vector<std::uint64_t>
ParseSizes(const std::string & path, const std::string & field, const std::string & text, std::size_t count);

/** The shortest text that is read as the same number; numbers with a space between them. */
std::string
FormatReal(double value);
std::string
JoinReals(const std::vector<double> & values);
std::string
JoinSizes(const std::vector<std::uint64_t> & values);

/** The names that a pattern such as slice%03d.raw stands for; it holds one conversion of an integer and nothing else.
 */
std::vector<std::string>
ExpandPattern(const std::string & path,
              const std::string & pattern,
              std::int64_t        first,
              std::int64_t        last,
              std::int64_t        step);

#endif
