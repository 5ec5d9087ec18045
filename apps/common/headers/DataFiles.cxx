// SPDX-License-Identifier: Apache-2.0
#include "headers/DataFiles.h"
#include "system/files/InputFile.h"
#include "text/HeaderText.h"

#include <filesystem>

namespace
{
/** The place after so many lines. */
std::uint64_t
SkipLines(const InputFile & file, std::uint64_t start, std::uint64_t lines)
{
  while (lines > 0)
  {
    const std::string text = file.ReadTextAt(start, 1 << 16);
    if (text.empty())
    {
      FailToRead(file.GetPath(), "it is truncated");
    }
    std::size_t position = 0;
    for (; lines > 0; --lines)
    {
      const auto end = text.find('\n', position);
      if (end == std::string::npos)
      {
        position = text.size();
        break;
      }
      position = end + 1;
    }
    start += position;
  }
  return start;
}

/** The part of a raw file that holds the voxels, and nothing after them. */
FileSection
FindRawVoxels(const InputFile & file, std::uint64_t start, std::int64_t byteSkip, std::uint64_t bytes)
{
  const std::uint64_t size = file.GetSize();
  const std::uint64_t skip =
    byteSkip < 0 ? (size - start > bytes ? size - start - bytes : 0) : static_cast<std::uint64_t>(byteSkip);
  const std::uint64_t available = size - start > skip ? size - start - skip : 0;
  if (available < bytes)
  {
    FailToRead(file.GetPath(),
               "it is truncated, with " + std::to_string(available) + " of " + std::to_string(bytes) +
                 " bytes of data");
  }
  if (available > bytes)
  {
    FailToRead(file.GetPath(),
               "it holds " + std::to_string(available) + " bytes of data, but its header says " +
                 std::to_string(bytes) + "; the size or the type of the image in the header is wrong");
  }
  return { file.GetPath(), start + skip, bytes };
}

FileSection
FindStream(const InputFile & file, std::uint64_t start, const DataFiles & files)
{
  const std::uint64_t available = file.GetSize() - start;
  if (files.CompressedSize > available || available == 0)
  {
    FailToRead(file.GetPath(), "its compressed data is truncated or damaged");
  }
  return { file.GetPath(), start, files.CompressedSize > 0 ? files.CompressedSize : available };
}
/** Whatever is in the file from there on. */
FileSection
FindText(const InputFile & file, std::uint64_t start, std::int64_t byteSkip)
{
  const std::uint64_t available = file.GetSize() - start;
  if (byteSkip < 0 || static_cast<std::uint64_t>(byteSkip) > available)
  {
    FailToRead(file.GetPath(), "its header says that " + std::to_string(byteSkip) + " bytes come before the text");
  }
  const auto skip = static_cast<std::uint64_t>(byteSkip);
  return { file.GetPath(), start + skip, available - skip };
}
} // namespace

void
LocateData(const std::string & path, const DataFiles & files, PlainLayout & layout)
{
  const std::uint64_t bytes = layout.Description.GetBytes();
  const bool          isCompressed = layout.Encoding == PlainEncoding::Compressed;
  const std::size_t   count = files.Names.empty() ? 1 : files.Names.size();
  if (bytes % count != 0)
  {
    FailToRead(path, "its voxels cannot be spread over " + std::to_string(count) + " data files like that");
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const bool          isOwn = files.Names.empty();
    const std::string   name = isOwn ? path : (std::filesystem::path(path).parent_path() / files.Names[i]).string();
    const InputFile     file(name);
    const std::uint64_t start = SkipLines(file, isOwn ? files.HeaderEnd : 0, files.LineSkip);
    layout.Sections.push_back(isCompressed ? FindStream(file, start, files)
                              : layout.Encoding == PlainEncoding::Raw
                                ? FindRawVoxels(file, start, files.ByteSkip, bytes / count)
                                : FindText(file, start, files.ByteSkip));
  }
}
