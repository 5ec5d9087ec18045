// SPDX-License-Identifier: Apache-2.0
#include "itk/FileIntegrity.h"
#include "itk/VtkFile.h"
#include "nifti/NiftiFiles.h"
#include "nifti/NiftiHeader.h"

#include "itkStreamingImageIOBase.h"
#include "itk_zlib.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <vector>

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

void
CheckBytes(const std::string & path, std::uint64_t available, std::uint64_t expected)
{
  if (available < expected)
  {
    throw std::runtime_error("cannot read " + path + ": it is truncated, with " + std::to_string(available) + " of " +
                             std::to_string(expected) + " bytes");
  }
}

/** Checks that there are exactly so many bytes, and that a compressed stream ends with them.
 * \param bytes are at the start */
void
CheckLength(const std::string & path, Bytes & bytes, std::uint64_t expected)
{
  CheckBytes(path, bytes.Skip(expected), expected);
  if (bytes.Skip(1) != 0)
  {
    throw std::runtime_error("cannot read " + path + ": it holds more than the " + std::to_string(expected) +
                             " bytes that its header says; the size or the type of the image in the header is wrong");
  }
  if (!bytes.EndsWell())
  {
    throw std::runtime_error("cannot read " + path + ": its compressed data is truncated or damaged");
  }
}

void
CheckForFaults(const std::string & path, const NiftiHeader & header)
{
  const std::string fault = header.GetDataBytes() == 0
                              ? "it has no voxels: a size (dim) or the bits of a voxel (bitpix) in its header are 0"
                              : header.FindFault();
  if (!fault.empty())
  {
    throw std::runtime_error("cannot read " + path + ": " + fault);
  }
}

void
CheckNiftiPair(const std::string & path)
{
  const NiftiPair   files = FindNiftiPair(path);
  const NiftiHeader header(files.Header);
  if (header.IsOfPair())
  {
    CheckForFaults(path, header);
    const std::uint64_t expected = header.GetDataOffset() + header.GetDataBytes();
    Bytes               bytes(files.Voxels);
    CheckLength(files.Voxels, bytes, expected);
  }
}

void
CheckNifti(const std::string & path)
{
  if (IsNiftiPair(path))
  {
    CheckNiftiPair(path);
    return;
  }
  const NiftiHeader header(path);
  if (header.IsSingleFile())
  {
    CheckForFaults(path, header);
    const std::uint64_t expected = header.GetDataOffset() + header.GetDataBytes();
    Bytes               bytes(path);
    CheckLength(path, bytes, expected);
  }
}

void
CheckGipl(const std::string & path, const itk::ImageIOBase & imageIO)
{
  constexpr std::uint64_t header = 256;
  const std::uint64_t     expected = header + static_cast<std::uint64_t>(imageIO.GetImageSizeInBytes());
  Bytes                   bytes(path);
  CheckLength(path, bytes, expected);
}

[[noreturn]] void
FailOfEnd(const std::string & path)
{
  throw std::runtime_error("cannot read " + path + ": it is truncated");
}

/** The header tells the size of the file. */
void
CheckBmp(const std::string & path)
{
  std::ifstream                file(path, std::ios::binary);
  std::array<unsigned char, 6> start{};
  file.read(reinterpret_cast<char *>(start.data()), start.size());
  const std::uint64_t size =
    start[2] + (std::uint64_t{ start[3] } << 8) + (std::uint64_t{ start[4] } << 16) + (std::uint64_t{ start[5] } << 24);
  if (!file || std::filesystem::file_size(path) < size)
  {
    FailOfEnd(path);
  }
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
    FailOfEnd(path);
  }
  return header;
}

std::uint64_t
GetLittleEndian(const MrcHeader & header, std::size_t place)
{
  return header[place] + (std::uint64_t{ header[place + 1] } << 8) + (std::uint64_t{ header[place + 2] } << 16) +
         (std::uint64_t{ header[place + 3] } << 24);
}

/** The header tells which axis of space is the fastest one and which the slowest, and how long the file is. */
void
CheckMrc(const std::string & path, const itk::ImageIOBase & imageIO)
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
    throw std::runtime_error("cannot read " + path + ": its axes are stored in the order " + order +
                             " of x, y and z, of which only 1 2 3 is supported; have its program save it so");
  }
  Bytes bytes(path);
  CheckLength(path,
              bytes,
              header.size() + GetLittleEndian(header, extension) +
                static_cast<std::uint64_t>(imageIO.GetImageSizeInBytes()));
}

/** Reads the last voxel alone: reading regions, these formats do tell if there is nothing. */
void
CheckLastVoxel(const std::string & path, itk::ImageIOBase & imageIO)
{
  itk::ImageIORegion region(imageIO.GetNumberOfDimensions());
  for (unsigned int axis = 0; axis < imageIO.GetNumberOfDimensions(); ++axis)
  {
    region.SetIndex(axis, static_cast<itk::IndexValueType>(imageIO.GetDimensions(axis)) - 1);
    region.SetSize(axis, 1);
  }
  std::vector<char> voxel(imageIO.GetComponentSize() * imageIO.GetNumberOfComponents());
  imageIO.SetIORegion(region);
  try
  {
    imageIO.Read(voxel.data());
  }
  catch (const itk::ExceptionObject &)
  {
    throw std::runtime_error("cannot read " + path + ": it is truncated, and lacks its last voxel");
  }
}
} // namespace

void
CheckMrcByteOrder(const std::string & path)
{
  constexpr std::size_t   mode = 12; // a small number
  constexpr std::size_t   stamp = 212;
  constexpr unsigned char bigEndian = 0x11;
  const MrcHeader         header = ReadMrcHeader(path);
  if (header[stamp] == bigEndian || (header[mode] == 0 && header[mode + 3] != 0))
  {
    throw std::runtime_error("cannot read " + path +
                             ": its numbers are big-endian, of which only little-endian is supported; have its program "
                             "save it so");
  }
}

void
CheckFileIsWhole(const std::string & path, itk::ImageIOBase & imageIO)
{
  const std::string format = imageIO.GetNameOfClass();
  if (format == "NiftiImageIO")
  {
    CheckNifti(path);
  }
  else if (format == "GiplImageIO")
  {
    CheckGipl(path, imageIO);
  }
  else if (format == "MRCImageIO")
  {
    CheckMrc(path, imageIO);
  }
  else if (format == "BMPImageIO")
  {
    CheckBmp(path);
  }
  else if (format == "VTKImageIO")
  {
    CheckVtk(path, imageIO);
  }
  else if (dynamic_cast<itk::StreamingImageIOBase *>(&imageIO) != nullptr && imageIO.CanStreamRead())
  {
    CheckLastVoxel(path, imageIO);
  }
}

void
CheckMessages(const std::string & path, const std::string & messages)
{
  // libtiff's errors look like "TIFFReadDirectory: Failed to read ..."; its warnings have "Warning" there.
  std::istringstream text(messages);
  for (std::string line; std::getline(text, line);)
  {
    if (line.rfind("TIFF", 0) == 0 && line.find(": Warning") == std::string::npos)
    {
      throw std::runtime_error("cannot read " + path + ": it is truncated or damaged: " + line);
    }
  }
}
