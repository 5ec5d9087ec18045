// SPDX-License-Identifier: Apache-2.0
#include "nifti/NiftiFiles.h"
#include "text/HeaderText.h"

#include <algorithm>
#include <filesystem>

namespace fs = std::filesystem;

namespace
{
/** The ending of a name, in its own letters, if that is one of NIfTI's. */
std::string
GetEnding(const std::string & path)
{
  const std::string name = fs::path(path).filename().string();
  const std::string small = ToLower(name);
  for (const std::string ending : { ".nii.gz", ".img.gz", ".hdr.gz", ".nii", ".hdr", ".img" })
  {
    const std::size_t length = ending.size();
    if (name.size() > length && small.compare(small.size() - length, length, ending) == 0)
    {
      return name.substr(name.size() - length);
    }
  }
  return {};
}

/** The file with the stem and the ending or, compressed, ".gz" after it. */
std::string
FindFile(const std::string & path, const std::string & stem, const std::string & ending, const std::string & gz)
{
  std::error_code error; // a name may be too long to exist
  const bool      isPlain = fs::exists(stem + ending, error);
  const bool      isCompressed = fs::exists(stem + ending + gz, error);
  if (isPlain && isCompressed)
  {
    FailToRead(path,
               "both " + stem + ending + " and " + stem + ending + gz + " are there, and which is meant is not said; " +
                 "move one of them away");
  }
  if (!isPlain && !isCompressed)
  {
    FailToRead(path, "its other file is not there: " + stem + ending);
  }
  return stem + ending + (isPlain ? "" : gz);
}
} // namespace

bool
HasNiftiEndingInMixedCase(const std::string & path)
{
  const std::string ending = GetEnding(path);
  const bool        hasSmall = std::any_of(ending.begin(), ending.end(), [](char c) { return c >= 'a' && c <= 'z'; });
  return hasSmall && ending != ToLower(ending);
}

std::string
GetMistakenNiftiEnding(const std::string & path)
{
  const std::string ending = GetEnding(path);
  const bool        isCompressed = ToLower(ending) == ".nii.gz";
  return isCompressed && fs::exists(path.substr(0, path.size() - 3)) ? ending : std::string();
}

bool
IsNiftiPair(const std::string & path)
{
  const std::string ending = ToLower(GetEnding(path));
  return !ending.empty() && ending.rfind(".nii", 0) != 0;
}

NiftiPair
FindNiftiPair(const std::string & path)
{
  const std::string ending = GetEnding(path);
  const std::string stem = path.substr(0, path.size() - ending.size());
  const bool        isSmall = ending == ToLower(ending);
  const std::string gz = isSmall ? ".gz" : ".GZ";
  return { FindFile(path, stem, isSmall ? ".hdr" : ".HDR", gz), FindFile(path, stem, isSmall ? ".img" : ".IMG", gz) };
}

std::vector<fs::path>
ListWrittenPair(const std::string & path)
{
  const std::string ending = GetEnding(path);
  const std::string stem = path.substr(0, path.size() - ending.size());
  const std::string gz = ending.substr(ending.find_first_not_of('.') + 3); // ".gz" or nothing
  const bool        isSmall = ending == ToLower(ending);
  return { stem + (isSmall ? ".hdr" : ".HDR") + gz, stem + (isSmall ? ".img" : ".IMG") + gz };
}

std::vector<fs::path>
ListOtherPair(const std::string & path)
{
  std::vector<fs::path> others;
  for (const fs::path & file : IsNiftiPair(path) ? ListWrittenPair(path) : std::vector<fs::path>{})
  {
    const std::string ending = GetEnding(file.string());
    const bool        isCompressed = HasEnding(ToLower(ending), ".gz");
    const char *      gz = ending == ToLower(ending) ? ".gz" : ".GZ";
    others.push_back(isCompressed ? fs::path(file).replace_extension() : fs::path(file.string() + gz));
  }
  return others;
}
