// SPDX-License-Identifier: Apache-2.0
#include "commandline/CommandLine.h"

#include "plain/RawReader.h"
#include "text/HeaderText.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>

namespace
{
/** Finite numbers with commas between. */
std::vector<double>
ParseNumbers(const std::string & text)
{
  std::vector<double> numbers;
  for (const std::string & word : CLI::detail::split(text, ','))
  {
    if (!IsNumber(word) || !std::isfinite(std::stod(word)))
    {
      throw std::invalid_argument("it must be made of numbers with commas between, such as 0.02,0.02,0.05, not " +
                                  text);
    }
    numbers.push_back(std::stod(word));
  }
  return numbers;
}

std::vector<double>
ParseSpacing(const std::string & text)
{
  std::vector<double> numbers = ParseNumbers(text);
  if (std::any_of(numbers.begin(), numbers.end(), [](double number) { return number <= 0.0; }))
  {
    throw std::invalid_argument("it must be greater than 0, not " + text);
  }
  return numbers;
}

/** A whole number from 0 on. */
unsigned int
ParseNumber(const std::string & text)
{
  constexpr std::size_t mostDigits = 9;
  if (text.empty() || text.size() > mostDigits || text.find_first_not_of("0123456789") != std::string::npos)
  {
    throw std::invalid_argument("it must be a whole number, counted from 0, not " + text);
  }
  return static_cast<unsigned int>(std::stoul(text));
}

/** Adds an option whose text a function turns into its value. */
template <typename TValue, typename TParse>
void
AddParsed(CLI::App &          app,
          const char *        name,
          const char *        type,
          TValue &            value,
          TParse &&           parse,
          const std::string & description)
{
  app
    .add_option_function<std::string>(
      name,
      [&value, parse, name](const std::string & text) {
        try
        {
          value = parse(text);
        }
        catch (const std::exception & error)
        {
          throw CLI::ValidationError(name, error.what());
        }
      },
      description)
    ->type_name(type);
}
/** The arguments in reverse, as CLI11 takes them. A name behind "--" that begins with '-' is written so that CLI11,
 * which does not always see that mark, takes it for no option. */
std::vector<std::string>
GetArguments(int argc, char * argv[])
{
  std::vector<std::string> arguments(argv + 1, argv + argc);
  auto                     name = std::find(arguments.begin(), arguments.end(), "--");
  for (; name != arguments.end(); ++name)
  {
    if (*name != "--" && name->front() == '-')
    {
      name->insert(0, "./");
    }
  }
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

/** How many letters to insert, to leave out or to change, or pairs of neighbours to swap, make one word of another. */
std::size_t
CountTypos(const std::string & a, const std::string & b)
{
  std::vector<std::vector<std::size_t>> counts(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
  {
    for (std::size_t j = 0; j <= b.size(); ++j)
    {
      std::size_t & count = counts[i][j];
      count =
        i == 0 || j == 0
          ? i + j
          : std::min(
              { counts[i - 1][j] + 1, counts[i][j - 1] + 1, counts[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1) });
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
      {
        count = std::min(count, counts[i - 2][j - 2] + 1);
      }
    }
  }
  return counts[a.size()][b.size()];
}

/** What an unknown option may mean, to say so; empty where nothing is near. */
std::string
GuessOption(const CLI::App & app, const std::string & unknown)
{
  constexpr std::size_t mostTypos = 2;
  const std::string     word = unknown.substr(0, unknown.find('='));
  std::size_t           least = mostTypos + 1;
  std::string           nearest;
  for (const CLI::Option * const option : app.get_options())
  {
    for (const std::string & name : option->get_lnames())
    {
      const std::size_t typos = CountTypos(word, "--" + name);
      if (typos < least)
      {
        least = typos;
        nearest = "; is --" + name + " meant?";
      }
    }
  }
  return nearest;
}

/** An unknown option makes its value, too, take the place of a file: where there is one, options alone are named. */
void
CheckNothingIsLeft(const CLI::App & app)
{
  std::vector<std::string> unknown = app.remaining();
  const auto               mark = std::find(unknown.begin(), unknown.end(), "--");
  if (mark != unknown.end())
  {
    unknown.erase(mark);
  }
  std::vector<std::string> options;
  std::copy_if(unknown.begin(), unknown.end(), std::back_inserter(options), [](const std::string & word) {
    return word.size() > 1 && word.front() == '-';
  });
  const std::vector<std::string> & named = options.empty() ? unknown : options;
  if (!named.empty())
  {
    throw UsageError((named.size() > 1 ? "unknown arguments: " : "unknown argument: ") + CLI::detail::join(named, " ") +
                     (options.size() == 1 ? GuessOption(app, options.front()) : ""));
  }
}

/** CLI11 takes an empty text, such as that of a variable that was not set, for 0. */
void
CheckNumbers(const CLI::App & app)
{
  for (const CLI::Option * const option : app.get_options())
  {
    const std::string type = option->get_type_name();
    const bool        isNumber = type.rfind("FLOAT", 0) == 0 || type.rfind("INT", 0) == 0 || type.rfind("UINT", 0) == 0;
    const auto &      values = option->results();
    if (isNumber && std::find(values.begin(), values.end(), "") != values.end())
    {
      throw UsageError(option->get_name() + ": a number is missing");
    }
  }
}
} // namespace

std::optional<int>
ParseArguments(CLI::App & app, int argc, char * argv[])
{
  app.allow_extras(); // CLI11 names those that are left over from the last to the first
  try
  {
    app.parse(GetArguments(argc, argv));
  }
  catch (const CLI::ParseError & error)
  {
    if (error.get_exit_code() == 0)
    {
      return app.exit(error);
    }
    throw UsageError(error.what());
  }
  CheckNothingIsLeft(app);
  CheckNumbers(app);
  return std::nullopt;
}

void
Require(const std::string & value, const char * name)
{
  if (value.empty())
  {
    throw UsageError(std::string(name) + " is required");
  }
}

void
AddInputOptions(CLI::App & app, InputOptions & options)
{
  app
    .add_option("--series", options.Series, "Where a folder holds several DICOM series: the UID of one, or its number")
    ->type_name("UID");
  AddParsed(app,
            "--spacing",
            "NUMBERS",
            options.Spacing,
            ParseSpacing,
            "The distance between voxels, instead of the file's: one number, or one for each axis with commas between");
  AddParsed(app,
            "--origin",
            "NUMBERS",
            options.Origin,
            ParseNumbers,
            "The place of the first voxel, instead of the file's: one number for each axis with commas between");
  AddParsed(app,
            "--channel",
            "NUMBER",
            options.Channel,
            ParseNumber,
            "The channel to take of a file with several, counted from 0");
  AddParsed(
    app, "--frame", "NUMBER", options.Frame, ParseNumber, "The frame to take of a series in time, counted from 0");
}

void
AddRawOption(CLI::App & app, const char * name, std::optional<RawLayout> & layout, const std::string & file)
{
  AddParsed(app,
            name,
            "LAYOUT",
            layout,
            ParseRawLayout,
            file + " has no header: its size x, y, z and its type, such as 1024x1024x800:uint16; then :big for " +
              "big-endian numbers, +N for N bytes to skip");
}

CLI::Validator
OneOf(const std::vector<std::string> & words)
{
  return CLI::Validator(
    [words](std::string & text) {
      const auto isMeant = [&text](const std::string & word) { return ToLower(word) == ToLower(text); };
      const auto found = std::find_if(words.begin(), words.end(), isMeant);
      if (found == words.end())
      {
        return "it must be one of " + CLI::detail::join(words, ", ") + ", not " + text;
      }
      text = *found;
      return std::string();
    },
    "");
}

std::uint64_t
ParseBytes(const std::string & text)
{
  const char * const message = "it must be a size such as 500M, 0.5G or 1.5GiB, not ";
  char *             end = nullptr;
  const double       number = std::strtod(text.c_str(), &end);
  std::string        unit = ToLower(end);
  double             base = 1000.0;
  unit.erase(0, unit.find_first_not_of(' ') == std::string::npos ? unit.size() : unit.find_first_not_of(' '));
  if (!unit.empty() && unit.back() == 'b')
  {
    unit.pop_back();
  }
  if (unit.size() == 2 && unit.back() == 'i')
  {
    base = 1024.0;
    unit.pop_back();
  }
  const std::string units = "kmgt";
  const auto        place = units.find(unit);
  const double      bytes = number * (unit.empty() ? 1.0 : std::pow(base, static_cast<double>(place + 1)));
  constexpr double  largest = 1e18;
  if (end == text.c_str() || unit.size() > 1 || place == std::string::npos || !(bytes >= 1.0 && bytes <= largest))
  {
    throw std::invalid_argument(message + text);
  }
  return static_cast<std::uint64_t>(bytes);
}

bool
IsNumber(const std::string & text)
{
  char * end = nullptr;
  errno = 0;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && errno != ERANGE;
}

void
PrintResult(const std::string & text)
{
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
  {
    throw std::runtime_error("cannot print the result: " + std::string(std::strerror(errno)));
  }
}
