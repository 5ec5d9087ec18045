// SPDX-License-Identifier: Apache-2.0
#include "plain/TextReader.h"
#include "plain/ByteOrder.h"
#include "system/files/InputFile.h"
#include "text/HeaderText.h"
#include "text/TextNumbers.h"
#include "volumes/BoxRuns.h"

#include <algorithm>
#include <cstring>

namespace
{
template <typename TFunction>
void
ForEachPart(const FileSection & section, TFunction && function)
{
  constexpr std::uint64_t longest = 1 << 20;
  const InputFile         file(section.Path);
  for (std::uint64_t done = 0; done < section.Size;)
  {
    const std::string part = file.ReadTextAt(section.Offset + done, std::min(longest, section.Size - done));
    if (part.empty())
    {
      FailToRead(section.Path, "it is truncated");
    }
    function(part);
    done += part.size();
  }
}

[[noreturn]] void
FailOfMore(const std::string & path)
{
  FailToRead(
    path,
    "it holds more than its header says; the size or the type of the image in the header is wrong, or the file "
    "is damaged");
}

/** \param count of elements */
void
ReadNumbers(const FileSection & section, const PlainLayout & layout, std::uint64_t count, char * out)
{
  // A writer of NRRD may put commas between the numbers.
  const char * const separators = layout.Description.Format == "NRRD" ? "," : "";
  TextNumbers        numbers(section.Path, layout.Description.Component, count, out, separators);
  ForEachPart(section, [&](const std::string & part) { numbers.Add(part); });
  if (!numbers.Finish().empty())
  {
    FailOfMore(section.Path);
  }
}

int
GetDigit(const char c)
{
  const auto place = std::string("0123456789abcdefABCDEF").find(c);
  return place == std::string::npos ? -1 : static_cast<int>(place < 16 ? place : place - 6);
}

/** \param count of bytes */
void
ReadDigits(const FileSection & section, std::uint64_t count, char * out)
{
  std::uint64_t digits = 0;
  ForEachPart(section, [&](const std::string & part) {
    for (const char c : part)
    {
      const int digit = GetDigit(c);
      if (digit >= 0 && digits == 2 * count)
      {
        FailOfMore(section.Path);
      }
      if (digit >= 0)
      {
        char & byte = out[digits / 2];
        byte = static_cast<char>(digits % 2 == 0 ? 16 * digit : static_cast<unsigned char>(byte) + digit);
        ++digits;
      }
      else if (std::strchr(" \t\r\n\v\f", c) == nullptr || c == '\0')
      {
        FailToRead(section.Path, "it has characters among its voxels that are no hexadecimal digits");
      }
    }
  });
  if (digits < 2 * count)
  {
    FailToRead(section.Path,
               "it is truncated, with " + std::to_string(digits / 2) + " of " + std::to_string(count) +
                 " bytes of data");
  }
}
} // namespace

TextReader::TextReader(const std::string & path, const PlainLayout & layout)
  : m_Files({ path })
{
  m_Description = layout.Description;
  const std::size_t   elementBytes = itk::Subdivision::SizeOf(m_Description.Component);
  const std::uint64_t bytes = m_Description.GetBytes();
  const std::uint64_t part = bytes / layout.Sections.size();
  for (const FileSection & section : layout.Sections)
  {
    // A voxel takes a character at least, so that a header that lies takes no memory.
    if (section.Size < part / elementBytes)
    {
      FailToRead(section.Path, "it is truncated, with " + std::to_string(section.Size) + " characters of voxels");
    }
    m_Files.push_back(section.Path);
  }
  m_Voxels.resize(static_cast<std::size_t>(bytes));
  char * out = m_Voxels.data();
  for (const FileSection & section : layout.Sections)
  {
    if (layout.Encoding == PlainEncoding::Hex)
    {
      ReadDigits(section, part, out);
      TurnToMachine(layout.IsBigEndian, elementBytes, out, part);
    }
    else
    {
      ReadNumbers(section, layout, part / elementBytes, out);
    }
    out += part;
  }
}

std::vector<std::string>
TextReader::GetFiles() const
{
  return m_Files;
}

bool
TextReader::ReadsParts() const
{
  return false;
}

std::uint64_t
TextReader::GetScratchBytes(std::uint64_t) const
{
  return 0;
}

void
TextReader::Read(const itk::Subdivision::Box & box, void * voxels)
{
  const std::uint64_t voxelBytes = m_Description.GetVoxelBytes();
  char *              bytes = static_cast<char *>(voxels);
  ForEachRun(m_Description.Grid.Size, box, [&](std::uint64_t first, std::uint64_t count) {
    std::memcpy(bytes, m_Voxels.data() + first * voxelBytes, count * voxelBytes);
    bytes += count * voxelBytes;
  });
}
