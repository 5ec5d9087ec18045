// SPDX-License-Identifier: Apache-2.0
#include "formats/InputSafety.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace fs = std::filesystem;

namespace
{
/** Whether a path is a folder, or lies in it, when links are followed. */
bool
IsIn(const fs::path & path, const fs::path & folder)
{
  std::error_code error;
  const fs::path  inner = fs::canonical(path, error);
  const fs::path  outer = error ? fs::path() : fs::canonical(folder, error);
  return !error && std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

bool
Replaces(const fs::path & replaced, const fs::path & file)
{
  std::error_code error;
  return fs::is_directory(replaced, error) ? IsIn(file, replaced) : fs::equivalent(replaced, file, error);
}

/** One of several, empty for none. */
fs::path
FindReplaced(const std::vector<fs::path> & replaced, const std::vector<std::string> & files)
{
  const auto found = std::find_if(files.begin(), files.end(), [&](const std::string & file) {
    return std::any_of(replaced.begin(), replaced.end(), [&](const fs::path & other) { return Replaces(other, file); });
  });
  return found == files.end() ? fs::path() : fs::path(*found);
}

/** Whether the output was named as a file of the input, and all files of the input give way to it. */
bool
IsInPlace(const std::string & input, const std::vector<fs::path> & replaced, const std::vector<std::string> & files)
{
  std::error_code error;
  const fs::path  output = replaced.front();
  const auto      isReplaced = [&](const std::string & file) { return !FindReplaced(replaced, { file }).empty(); };
  return !fs::is_directory(input, error) && !fs::is_directory(output, error) &&
         std::any_of(files.begin(), files.end(), [&](const std::string & file) { return Replaces(output, file); }) &&
         std::all_of(files.begin(), files.end(), isReplaced);
}
} // namespace

void
CheckInputStays(const std::string &  input,
                const VolumeReader & reader,
                const std::string &  output,
                const VolumeWriter & writer,
                const InPlace        inPlace)
{
  const auto refuse = [&output](const std::string & reason) {
    throw std::runtime_error("cannot write " + output + ": " + reason);
  };
  const std::vector<fs::path>    replaced = writer.GetReplacedFiles();
  const std::vector<std::string> files = reader.GetFiles();
  std::error_code                error;
  if (fs::is_directory(replaced.front(), error) && IsIn(input, replaced.front()))
  {
    refuse("the input " + input + " is there; name another folder");
  }
  const fs::path file = FindReplaced(replaced, files);
  if (file.empty())
  {
    return;
  }
  if (!IsInPlace(input, replaced, files))
  {
    refuse("it would replace " + file.string() + ", which belongs to the input " + input + "; name another output");
  }
  if (inPlace == InPlace::Refused)
  {
    refuse("it is the input, of which a piece that is run again would make another; name another output");
  }
}
