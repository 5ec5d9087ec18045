// SPDX-License-Identifier: Apache-2.0
#include "itk/FileLength.h"
#include "nifti/NiftiFiles.h"
#include "nifti/NiftiHeader.h"
#include "text/HeaderText.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <vector>

#include <zlib.h>

namespace
{
/** A file, gzip or not, seen from its start. */
class Bytes
{
public:
  explicit Bytes(const std::string & path)
    : m_File(gzopen(path.c_str(), "rb"), gzclose)
  {}

  /** Reads on; returns the number of bytes that were there. */
  std::uint64_t
  Read(char * bytes, std::uint64_t count)
  {
    const int read = m_File != nullptr ? gzread(m_File.get(), bytes, static_cast<unsigned int>(count)) : -1;
    return read > 0 ? static_cast<std::uint64_t>(read) : 0;
  }

  /** Reads on, up to \c count bytes; returns the number of bytes that were there. */
  std::uint64_t
  Skip(std::uint64_t count)
  {
    std::vector<char> buffer(1 << 18);
    std::uint64_t     done = 0;
    while (done < count)
    {
      const std::uint64_t read = this->Read(buffer.data(), std::min<std::uint64_t>(buffer.size(), count - done));
      if (read == 0)
      {
        break;
      }
      done += read;
    }
    return done;
  }

  /** Reads to the end; returns whether the end of a compressed stream is there, with the checksum of what came before.
   */
  bool
  EndsWell()
  {
    std::vector<char> buffer(1 << 18);
    while (this->Read(buffer.data(), buffer.size()) > 0)
    {
    }
    int error = Z_OK;
    gzerror(m_File.get(), &error);
    return error == Z_OK || error == Z_STREAM_END;
  }

private:
  std::unique_ptr<gzFile_s, int (*)(gzFile)> m_File;
};

/** Checks that there are exactly so many bytes, and that a compressed stream ends with them.
 * \param bytes are at the start */
void
CheckLength(const std::string & path, Bytes & bytes, std::uint64_t expected)
{
  const std::uint64_t available = bytes.Skip(expected);
  if (available < expected)
  {
    FailToRead(path,
               "it is truncated, with " + std::to_string(available) + " of " + std::to_string(expected) + " bytes");
  }
  if (bytes.Skip(1) != 0)
  {
    FailToRead(path,
               "it holds more than the " + std::to_string(expected) +
                 " bytes that its header says; the size or the type of the image in the header is wrong");
  }
  if (!bytes.EndsWell())
  {
    FailToRead(path, "its compressed data is truncated or damaged");
  }
}

/** \param voxels the file that they are in */
void
CheckNiftiVoxels(const std::string & path, const NiftiHeader & header, const std::string & voxels)
{
  const std::string fault = header.GetDataBytes() == 0
                              ? "it has no voxels: a size (dim) or the bits of a voxel (bitpix) in its header are 0"
                              : header.FindFault();
  if (!fault.empty())
  {
    FailToRead(path, fault);
  }
  Bytes bytes(voxels);
  CheckLength(voxels, bytes, header.GetDataOffset() + header.GetDataBytes());
}

using MrcHeader = std::array<unsigned char, 1024>;

MrcHeader
ReadMrcHeader(const std::string & path)
{
  MrcHeader     header{};
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char *>(header.data()), header.size());
  if (!file)
  {
    FailToRead(path, "it is truncated");
  }
  return header;
}

std::uint64_t
GetLittleEndian(const MrcHeader & header, std::size_t place)
{
  return header[place] + (std::uint64_t{ header[place + 1] } << 8) + (std::uint64_t{ header[place + 2] } << 16) +
         (std::uint64_t{ header[place + 3] } << 24);
}
} // namespace

void
CheckNiftiLength(const std::string & path)
{
  const bool        isPair = IsNiftiPair(path);
  const NiftiPair   files = isPair ? FindNiftiPair(path) : NiftiPair{ path, path };
  const NiftiHeader header(files.Header);
  if (isPair && header.IsSingleFile())
  {
    FailToRead(path,
               "it is one of two files, but the header says that the voxels are in the same file (magic n+1); name the "
               "header's file .nii, or set the magic to ni1");
  }
  if (!isPair && header.IsOfPair() && !header.IsSingleFile())
  {
    FailToRead(path,
               "its header says that the voxels are in a file of their own (no magic n+1); name the files .hdr and "
               ".img, or set the magic to n+1");
  }
  if (header.IsSingleFile() || header.IsOfPair())
  {
    CheckNiftiVoxels(path, header, files.Voxels);
  }
}

void
CheckGiplLength(const std::string & path, const std::uint64_t bytes)
{
  constexpr std::uint64_t header = 256;
  Bytes                   file(path);
  CheckLength(path, file, header + bytes);
}

void
CheckMrcByteOrder(const std::string & path)
{
  constexpr std::size_t   mode = 12; // a small number
  constexpr std::size_t   stamp = 212;
  constexpr unsigned char bigEndian = 0x11;
  const MrcHeader         header = ReadMrcHeader(path);
  if (header[stamp] == bigEndian || (header[mode] == 0 && header[mode + 3] != 0))
  {
    FailToRead(path,
               "its numbers are big-endian, of which only little-endian is supported; have its program save it so");
  }
}

void
CheckMrcLength(const std::string & path, const std::uint64_t bytes)
{
  constexpr std::size_t axes = 64;
  constexpr std::size_t extension = 92;
  const MrcHeader       header = ReadMrcHeader(path);
  std::string           order;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    order += (axis > 0 ? " " : "") + std::to_string(GetLittleEndian(header, axes + 4 * axis));
  }
  if (order != "1 2 3" && order != "0 0 0")
  {
    FailToRead(path,
               "its axes are stored in the order " + order +
                 " of x, y and z, of which only 1 2 3 is supported; have its program save it so");
  }
  Bytes file(path);
  CheckLength(path, file, header.size() + GetLittleEndian(header, extension) + bytes);
}

void
CheckBmpLength(const std::string & path)
{
  std::ifstream                file(path, std::ios::binary);
  std::array<unsigned char, 6> start{};
  file.read(reinterpret_cast<char *>(start.data()), start.size());
  const std::uint64_t size =
    start[2] + (std::uint64_t{ start[3] } << 8) + (std::uint64_t{ start[4] } << 16) + (std::uint64_t{ start[5] } << 24);
  if (!file || std::filesystem::file_size(path) < size)
  {
    FailToRead(path, "it is truncated");
  }
}
