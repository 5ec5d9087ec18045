// SPDX-License-Identifier: Apache-2.0
#include "plain/PlainReader.h"
#include "headers/MetaHeader.h"
#include "headers/NrrdHeader.h"
#include "plain/ByteOrder.h"
#include "plain/TextReader.h"
#include "text/HeaderText.h"
#include "volumes/BoxRuns.h"

#include <algorithm>
#include <cstring>

namespace
{
constexpr std::size_t MostOpenFiles = 64;
} // namespace

PlainReader::PlainReader(const std::string & path, const PlainLayout & layout)
  : m_Path(path)
  , m_Layout(layout)
{
  m_Description = layout.Description;
  if (layout.Encoding == PlainEncoding::Compressed)
  {
    m_Stream = std::make_unique<InflateStream>(layout.Sections.front());
  }
  else if (layout.Sections.size() <= MostOpenFiles)
  {
    for (const FileSection & section : layout.Sections)
    {
      m_Files.emplace_back(section.Path);
    }
  }
}

std::vector<std::string>
PlainReader::GetFiles() const
{
  std::vector<std::string> files = { m_Path };
  for (const FileSection & section : m_Layout.Sections)
  {
    files.push_back(section.Path);
  }
  return files;
}

bool
PlainReader::ReadsParts() const
{
  return true;
}

std::uint64_t
PlainReader::GetScratchBytes(std::uint64_t partBytes) const
{
  return m_Stream != nullptr ? partBytes + InflateStream::ScratchBytes : 0;
}

void
PlainReader::Read(const itk::Subdivision::Box & box, void * voxels)
{
  const std::uint64_t voxelBytes = m_Description.GetVoxelBytes();
  char *              bytes = static_cast<char *>(voxels);
  ForEachRun(m_Description.Grid.Size, box, [&](std::uint64_t first, std::uint64_t count) {
    this->ReadBytes(first * voxelBytes, bytes, count * voxelBytes);
    bytes += count * voxelBytes;
  });
  TurnToMachine(m_Layout.IsBigEndian,
                itk::Subdivision::SizeOf(m_Description.Component),
                static_cast<char *>(voxels),
                static_cast<std::uint64_t>(bytes - static_cast<char *>(voxels)));
}

void
PlainReader::ReadBytes(std::uint64_t offset, char * bytes, std::uint64_t count)
{
  if (m_Stream != nullptr)
  {
    this->ReadCompressed(offset, bytes, count);
  }
  else
  {
    this->ReadStored(offset, bytes, count);
  }
}

void
PlainReader::ReadStored(std::uint64_t offset, char * bytes, std::uint64_t count)
{
  const std::uint64_t sectionSize = m_Layout.Sections.front().Size; // of each
  while (count > 0)
  {
    const auto          number = static_cast<std::size_t>(offset / sectionSize);
    const std::uint64_t place = offset % sectionSize;
    const std::uint64_t part = std::min(count, sectionSize - place);
    const FileSection & section = m_Layout.Sections[number];
    if (m_Files.empty())
    {
      InputFile(section.Path).ReadAt(section.Offset + place, bytes, part);
    }
    else
    {
      m_Files[number].ReadAt(section.Offset + place, bytes, part);
    }
    offset += part;
    bytes += part;
    count -= part;
  }
}

void
PlainReader::ReadCompressed(std::uint64_t offset, char * bytes, std::uint64_t count)
{
  char * const  first = bytes;
  std::uint64_t place = offset;
  std::uint64_t left = count;
  // What the last part had.
  if (place >= m_LastOffset && place < m_LastOffset + m_LastPart.size())
  {
    const std::uint64_t known = std::min(left, m_LastOffset + m_LastPart.size() - place);
    std::memcpy(bytes, m_LastPart.data() + (place - m_LastOffset), known);
    place += known;
    bytes += known;
    left -= known;
  }
  if (left > 0)
  {
    m_Stream->ReadAt(m_Layout.InflatedOffset + place, bytes, left);
    const std::uint64_t size = m_Description.GetBytes();
    if (offset + count == size)
    {
      m_Stream->CheckEnd();
    }
    m_LastPart.assign(first, first + count);
    m_LastOffset = offset;
  }
}

namespace
{
std::uint64_t
MeasureStream(const FileSection & section)
{
  return InflateStream(section).Measure();
}

std::unique_ptr<VolumeReader>
MakeReader(const std::string & path, const PlainLayout & layout)
{
  if (layout.Encoding == PlainEncoding::Text || layout.Encoding == PlainEncoding::Hex)
  {
    return std::make_unique<TextReader>(path, layout);
  }
  return std::make_unique<PlainReader>(path, layout);
}
} // namespace

std::unique_ptr<VolumeReader>
OpenMetaImage(const std::string & path)
{
  return MakeReader(path, ReadMetaHeader(path, MeasureStream));
}

std::unique_ptr<VolumeReader>
OpenNrrd(const std::string & path)
{
  return MakeReader(path, ReadNrrdHeader(path));
}

std::uint64_t
CheckNrrdNumbers(const std::string & path)
{
  const PlainLayout   layout = ReadNrrdNumbers(path);
  const std::uint64_t bytes = layout.Description.GetBytes();
  if (layout.Encoding == PlainEncoding::Text || layout.Encoding == PlainEncoding::Hex)
  {
    FailToRead(path, "voxels as text are not supported with axes like its own; save it with the encoding raw or gzip");
  }
  const std::uint64_t part = layout.InflatedOffset + bytes / layout.Sections.size();
  for (const FileSection & section : layout.Sections)
  {
    const std::uint64_t found = layout.Encoding == PlainEncoding::Compressed ? MeasureStream(section) : part;
    if (found != part)
    {
      FailToRead(section.Path,
                 "its compressed data holds " + std::to_string(found) + " bytes, but its header says " +
                   std::to_string(part) + "; the size or the type of the image in the header is wrong");
    }
  }
  return bytes;
}
