// SPDX-License-Identifier: Apache-2.0
#ifndef CommandLine_h
#define CommandLine_h

#include "volumes/VolumeReader.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

/** What the programs return. */
enum ExitCode
{
  Success = 0,
  RunFailed = 1,
  WrongUsage = 2
};

/** A command line that makes no sense. */
struct UsageError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** Reads the command line, in which all that follows "--" are names of files. Returns an exit code if the program has
 * nothing left to do (--help, --version).
 * \throw UsageError; arguments that the program does not know are named in their order */
std::optional<int>
ParseArguments(CLI::App & app, int argc, char * argv[]);

/** \throw UsageError if a positional argument was not given */
void
Require(const std::string & value, const char * name);

/** Adds what says how an input is to be read, all but --raw: --series, --spacing, --origin, --channel, --frame. */
void
AddInputOptions(CLI::App & app, InputOptions & options);

/** Adds an option for the layout of a file without a header. */
void
AddRawOption(CLI::App & app, const char * name, std::optional<RawLayout> & layout, const std::string & file);

/** One of these words, without regard to case. */
CLI::Validator
OneOf(const std::vector<std::string> & words);

/** A number of bytes: 500M, 0.5G (powers of 1000), 1.5GiB (powers of 1024).
 * \throw std::invalid_argument */
std::uint64_t
ParseBytes(const std::string & text);

/** Whether a text is one number that a double can have. */
bool
IsNumber(const std::string & text);

/** Prints what the user asked for to stdout.
 * \throw std::runtime_error if not all of it could be written */
void
PrintResult(const std::string & text);

#endif
