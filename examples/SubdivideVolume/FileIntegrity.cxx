// SPDX-License-Identifier: Apache-2.0
#include "FileIntegrity.h"

#include "itkMetaImageIO.h"
#include "itk_zlib.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace fs = std::filesystem;

namespace
{
/** What the text of a MetaImage header says beyond MetaIO's own interface. */
struct MetaHeader
{
  std::uint64_t Size = 0;           // bytes up to the data that follow in the same file
  std::uint64_t CompressedSize = 0; // 0 where it is not given
};

MetaHeader
ReadMetaHeader(const fs::path & path)
{
  MetaHeader    header;
  std::ifstream file(path, std::ios::binary);
  for (std::string line; std::getline(file, line);)
  {
    const auto value = line.find_first_not_of(" \t=", line.find_first_of(" \t="));
    if (line.rfind("CompressedDataSize", 0) == 0 && value != std::string::npos)
    {
      header.CompressedSize = std::strtoull(line.c_str() + value, nullptr, 10);
    }
    if (line.rfind("ElementDataFile", 0) == 0)
    {
      header.Size = static_cast<std::uint64_t>(file.tellg());
      break;
    }
  }
  return header;
}

/** Bytes that come out of a zlib or gzip stream; where it breaks off, those up to there. */
std::uint64_t
CountInflatedBytes(const fs::path & path, std::uint64_t offset)
{
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(offset));
  z_stream      stream = {};
  constexpr int anyHeader = 32 + MAX_WBITS;
  if (inflateInit2(&stream, anyHeader) != Z_OK)
  {
    return 0;
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
    } while (status == Z_OK && (stream.avail_in > 0 || stream.avail_out == 0));
    status = status == Z_BUF_ERROR ? Z_OK : status;
  }
  inflateEnd(&stream);
  return count;
}

[[noreturn]] void
FailTruncated(const fs::path & path, std::uint64_t available, std::uint64_t expected)
{
  throw std::runtime_error("cannot read " + path.string() + ": it is truncated or damaged, with " +
                           std::to_string(available) + " of " + std::to_string(expected) + " bytes of data");
}

void
CheckMetaImage(const fs::path & path, itk::MetaImageIO & imageIO)
{
  const MetaImage & image = *imageIO.GetMetaImagePointer();
  const std::string dataName = image.ElementDataFileName();
  const bool        severalFiles = dataName.rfind("LIST", 0) == 0 || dataName.find('%') != std::string::npos;
  if (severalFiles || !image.BinaryData())
  {
    return;
  }
  const MetaHeader header = ReadMetaHeader(path);
  const bool       local = dataName == "LOCAL" || dataName == "Local" || dataName == "local";
  const fs::path   data = local ? path : path.parent_path() / dataName;
  std::error_code  error;
  const auto       fileSize = fs::file_size(data, error);
  if (error)
  {
    throw std::runtime_error("cannot read " + data.string() + ": " + error.message());
  }
  const std::uint64_t offset = image.HeaderSize() > 0 ? image.HeaderSize() : local ? header.Size : 0;
  const std::uint64_t available = fileSize > offset ? fileSize - offset : 0;
  const auto          expected = static_cast<std::uint64_t>(imageIO.GetImageSizeInBytes());
  if (!image.CompressedData())
  {
    if (available < expected)
    {
      FailTruncated(data, available, expected);
    }
    return;
  }
  if (available < header.CompressedSize)
  {
    FailTruncated(data, available, header.CompressedSize);
  }
  const std::uint64_t inflated = CountInflatedBytes(data, offset);
  if (inflated < expected)
  {
    FailTruncated(data, inflated, expected);
  }
}
} // namespace

void
CheckFileIsWhole(const std::string & path, itk::ImageIOBase & imageIO)
{
  if (auto * const metaImageIO = dynamic_cast<itk::MetaImageIO *>(&imageIO))
  {
    CheckMetaImage(path, *metaImageIO);
  }
}
