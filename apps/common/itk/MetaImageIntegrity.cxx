// SPDX-License-Identifier: Apache-2.0
#include "itk/MetaImageIntegrity.h"
#include "itk/TextIntegrity.h"

#include "itkMetaImageIO.h"
#include "itk_zlib.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace fs = std::filesystem;

namespace
{
/** Bytes up to the data that follow the header in the same file. */
std::uint64_t
GetHeaderSize(const fs::path & path)
{
  std::ifstream file(path, std::ios::binary);
  for (std::string line; std::getline(file, line);)
  {
    if (line.rfind("ElementDataFile", 0) == 0)
    {
      return static_cast<std::uint64_t>(file.tellg());
    }
  }
  return 0;
}

/** Whether a zlib or gzip stream is whole, and gives that many bytes at least. */
bool
InflatesTo(const fs::path & path, std::uint64_t offset, std::uint64_t expected)
{
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(offset));
  z_stream      stream = {};
  constexpr int anyHeader = 32 + MAX_WBITS;
  if (inflateInit2(&stream, anyHeader) != Z_OK)
  {
    throw std::bad_alloc();
  }
  std::vector<char>          in(1 << 18);
  std::vector<unsigned char> out(1 << 18);
  std::uint64_t              count = 0;
  int                        status = Z_OK;
  while (status == Z_OK && (file.read(in.data(), static_cast<std::streamsize>(in.size())), file.gcount() > 0))
  {
    stream.next_in = reinterpret_cast<unsigned char *>(in.data());
    stream.avail_in = static_cast<unsigned int>(file.gcount());
    do
    {
      stream.next_out = out.data();
      stream.avail_out = static_cast<unsigned int>(out.size());
      status = inflate(&stream, Z_NO_FLUSH);
      count += out.size() - stream.avail_out;
    } while (status == Z_OK && stream.avail_out == 0);
    status = status == Z_BUF_ERROR ? Z_OK : status; // it only wants more input
  }
  inflateEnd(&stream);
  return status == Z_STREAM_END && count >= expected;
}
} // namespace

void
CheckMetaImageIsWhole(const std::string & path, itk::ImageIOBase & imageIO)
{
  const MetaImage & image = *dynamic_cast<itk::MetaImageIO &>(imageIO).GetMetaImagePointer();
  const std::string dataName = image.ElementDataFileName();
  const bool        severalFiles = dataName.rfind("LIST", 0) == 0 || dataName.find('%') != std::string::npos;
  if (severalFiles)
  {
    return; // read file by file
  }
  const bool      local = dataName == "LOCAL" || dataName == "Local" || dataName == "local";
  const fs::path  data = local ? fs::path(path) : fs::path(path).parent_path() / dataName;
  std::error_code error;
  const auto      fileSize = fs::file_size(data, error);
  if (error)
  {
    throw std::runtime_error("cannot read " + data.string() + ": " + error.message());
  }
  if (!image.BinaryData())
  {
    CheckTextIsWhole(data.string(), imageIO);
    return;
  }
  const std::uint64_t offset = image.HeaderSize() > 0 ? image.HeaderSize() : local ? GetHeaderSize(path) : 0;
  const std::uint64_t available = fileSize > offset ? fileSize - offset : 0;
  const auto          expected = static_cast<std::uint64_t>(imageIO.GetImageSizeInBytes());
  if (image.CompressedData() && !InflatesTo(data, offset, expected))
  {
    throw std::runtime_error("cannot read " + data.string() + ": its compressed data is truncated or damaged");
  }
  if (!image.CompressedData() && available < expected)
  {
    throw std::runtime_error("cannot read " + data.string() + ": it is truncated, with " + std::to_string(available) +
                             " of " + std::to_string(expected) + " bytes of data");
  }
}
