// SPDX-License-Identifier: Apache-2.0
#include "FuzzedFiles.h"

#include "itk/FileLength.h"

namespace
{
void
FuzzMrc(const std::string & path, const std::string & text, const std::uint64_t bytes)
{
  constexpr std::size_t header = 1024;
  const bool            isLong = text.size() >= header;
  const bool            isBig = isLong && (text[212] == 0x11 || (text[12] == 0 && text[15] != 0));
  FuzzExpect(IsRefused([&] { CheckMrcByteOrder(path); }) == (!isLong || isBig), "an MRC file's byte order");
  const std::string axes = isLong ? text.substr(64, 12) : "";
  const bool        isInOrder =
    axes == std::string("\1\0\0\0\2\0\0\0\3\0\0\0", 12) || axes == std::string("\0\0\0\0\0\0\0\0\0\0\0\0", 12);
  const bool isRight = isInOrder && text.size() == header + GetLittleEndian(text, 92, 4) + bytes;
  FuzzExpect(IsRefused([&] { CheckMrcLength(path, bytes); }) != isRight, "an MRC file's length");
}
} // namespace

void
FuzzLength(FuzzBytes & bytes, const FuzzFolder & folder)
{
  const unsigned int  format = bytes.Below(3);
  const std::uint64_t voxelBytes = bytes.UpTo(0xffff);
  const std::string   text = bytes.Rest();
  const std::string   path = folder.Write("length", text);
  if (format == 0)
  {
    const bool isRight = text.size() >= 6 && text.size() >= GetLittleEndian(text, 2, 4);
    FuzzExpect(IsRefused([&] { CheckBmpLength(path); }) != isRight, "a BMP file's length");
  }
  else if (text.compare(0, 2, "\x1f\x8b") == 0)
  {
    IsRefused([&] { CheckGiplLength(path, voxelBytes); });
  }
  else if (format == 1)
  {
    FuzzExpect(IsRefused([&] { CheckGiplLength(path, voxelBytes); }) != (text.size() == 256 + voxelBytes),
               "a GIPL file's length");
  }
  else
  {
    FuzzMrc(path, text, voxelBytes);
  }
}
