// SPDX-License-Identifier: Apache-2.0
#include "plain/PlainReader.h"
#include "headers/MetaHeader.h"
#include "headers/NrrdHeader.h"
#include "text/HeaderText.h"
#include "volumes/BoxRuns.h"

#include <algorithm>
#include <cstring>

namespace
{
constexpr std::size_t MostOpenFiles = 64;

template <std::size_t VSize>
void
SwapElements(char * bytes, std::uint64_t count)
{
  for (char * const end = bytes + count; bytes != end; bytes += VSize)
  {
    std::reverse(bytes, bytes + VSize);
  }
}

void
SwapBytes(std::size_t elementSize, char * bytes, std::uint64_t count)
{
  if (elementSize == 2)
  {
    SwapElements<2>(bytes, count);
  }
  else if (elementSize == 4)
  {
    SwapElements<4>(bytes, count);
  }
  else if (elementSize == 8)
  {
    SwapElements<8>(bytes, count);
  }
}

bool
IsBigEndianMachine()
{
  const std::uint16_t one = 1;
  char                first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}
} // namespace

PlainReader::PlainReader(const std::string & path, const PlainLayout & layout)
  : m_Path(path)
  , m_Layout(layout)
{
  m_Description = layout.Description;
  if (layout.IsCompressed)
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
  return m_Layout.IsCompressed ? partBytes + InflateStream::ScratchBytes : 0;
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
  if (m_Layout.IsBigEndian != IsBigEndianMachine())
  {
    const auto count = static_cast<std::uint64_t>(bytes - static_cast<char *>(voxels));
    SwapBytes(itk::Subdivision::SizeOf(m_Description.Component), static_cast<char *>(voxels), count);
  }
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
    const std::uint64_t size = m_Description.GetNumberOfVoxels() * m_Description.GetVoxelBytes();
    if (offset + count == size)
    {
      m_Stream->CheckEnd();
    }
    m_LastPart.assign(first, first + count);
    m_LastOffset = offset;
  }
}

std::unique_ptr<VolumeReader>
OpenMetaImage(const std::string & path)
{
  return std::make_unique<PlainReader>(path, ReadMetaHeader(path));
}

std::unique_ptr<VolumeReader>
OpenNrrd(const std::string & path)
{
  return std::make_unique<PlainReader>(path, ReadNrrdHeader(path));
}
