// SPDX-License-Identifier: Apache-2.0
#include "pieces/PieceWriter.h"
#include "headers/PlainHeader.h"
#include "system/files/InputFile.h"

#include <algorithm>
#include <stdexcept>

#include <zlib.h>

namespace fs = std::filesystem;

std::unique_ptr<PieceWriter>
CreatePieceWriter(const std::string & path, const OutputOptions & options, const WarningSink & warn)
{
  std::error_code error;
  if (IsPlainFormat(path))
  {
    return CreatePlainPieceWriter(path, options, warn);
  }
  if (path.back() == '/' || fs::is_directory(path, error))
  {
    return CreateSlicePieceWriter(path, options, warn);
  }
  throw std::runtime_error(
    "cannot write " + path +
    ": several processes write the pieces of .mha, .mhd, .nrrd and .nhdr files and of folders of "
    "slices (a name that ends in /)");
}

std::uint32_t
AddToChecksum(const std::uint32_t checksum, const void * bytes, std::uint64_t count)
{
  return static_cast<std::uint32_t>(crc32_z(checksum, static_cast<const unsigned char *>(bytes), count));
}

std::uint32_t
AddToChecksum(std::uint32_t checksum, const fs::path & file, std::uint64_t offset, std::uint64_t count)
{
  const InputFile   input(file.string());
  std::vector<char> bytes(std::min<std::uint64_t>(count, 1 << 22));
  while (count > 0)
  {
    const auto part = std::min<std::uint64_t>(count, bytes.size());
    input.ReadAt(offset, bytes.data(), part);
    checksum = AddToChecksum(checksum, bytes.data(), part);
    offset += part;
    count -= part;
  }
  return checksum;
}
