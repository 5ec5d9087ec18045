// SPDX-License-Identifier: Apache-2.0
#include "itk/TextIntegrity.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

void
CheckTextIsWhole(const std::string & path, const itk::ImageIOBase & imageIO)
{
  const auto    expected = static_cast<std::uint64_t>(imageIO.GetImageSizeInComponents());
  std::uint64_t count = 0;
  std::uint64_t most = 0; // numbers in a row, between the words of the header and those after the voxels
  std::ifstream file(path, std::ios::binary);
  for (std::string word; most < expected && file >> word;)
  {
    char * end = nullptr;
    std::strtod(word.c_str(), &end);
    count = *end == '\0' ? count + 1 : 0;
    most = std::max(most, count);
  }
  if (most < expected)
  {
    throw std::runtime_error("cannot read " + path + ": it is truncated, with " + std::to_string(most) + " of " +
                             std::to_string(expected) + " numbers");
  }
}
