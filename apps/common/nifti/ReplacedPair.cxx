// SPDX-License-Identifier: Apache-2.0
#include "nifti/ReplacedPair.h"
#include "nifti/NiftiFiles.h"
#include "nifti/NiftiHeader.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace fs = std::filesystem;

void
CheckReplacedPair(const std::string & path)
{
  const std::vector<fs::path> files = IsNiftiPair(path) ? ListWrittenPair(path) : std::vector<fs::path>{};
  const bool areBoth = std::all_of(files.begin(), files.end(), [](const fs::path & file) { return fs::exists(file); });
  if (!files.empty() && areBoth && !IsNiftiHeader(files.front().string()))
  {
    const fs::path & other = fs::path(path) == files.front() ? files.back() : files.front();
    throw std::runtime_error("it would replace the file " + other.string() + " too, and " + files.front().string() +
                             " is no header of NIfTI or Analyze; name another output");
  }
}
