// SPDX-License-Identifier: Apache-2.0
// Runs a fuzzer's function on files that were kept, without a fuzzer: Replay FOLDER ...

#include "FuzzBytes.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

int
main(const int argc, char ** const argv)
{
  std::size_t files = 0;
  for (int i = 1; i < argc; ++i)
  {
    for (const auto & entry : std::filesystem::directory_iterator(argv[i]))
    {
      std::ifstream           file(entry.path(), std::ios::binary);
      const std::vector<char> bytes{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
      // A fuzzer's abort() names no file.
      std::cout << entry.path().filename().string() << std::endl;
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t *>(bytes.data()), bytes.size());
      ++files;
    }
  }
  std::cout << files << " files replayed\n";
  return files > 0 ? 0 : 1;
}
