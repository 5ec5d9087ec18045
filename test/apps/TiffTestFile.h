// SPDX-License-Identifier: Apache-2.0
#ifndef TiffTestFile_h
#define TiffTestFile_h

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

/** Numbers as bytes in either order. */
template <typename T>
std::string
ToBytes(const std::vector<T> & numbers, bool isBigEndian)
{
  std::string bytes;
  for (const T number : numbers)
  {
    char own[sizeof(T)];
    std::memcpy(own, &number, sizeof(T));
    if (isBigEndian)
    {
      std::reverse(own, own + sizeof(T));
    }
    bytes.append(own, sizeof(T));
  }
  return bytes;
}

/** A page as the TIFF specification has it, put together by hand: what a test's reader is to understand. */
struct TiffTestPage
{
  std::uint32_t              Width = 0;
  std::uint32_t              Height = 0;
  std::uint16_t              Bits = 8;
  std::uint16_t              Format = 1; // 1 unsigned, 2 signed, 3 floating point
  std::uint16_t              Samples = 1;
  std::uint16_t              Photometric = 1;
  bool                       IsPlanar = false;
  std::uint32_t              RowsPerStrip = 0; // 0: all
  std::uint32_t              TileSize = 0;     // 0: strips
  std::uint32_t              SubfileType = 0;
  std::string                Description;
  std::uint32_t              PixelsPerCentimetre = 0;
  std::uint32_t              PixelsPerNothing = 0; // a resolution without a unit
  std::uint16_t              Orientation = 0;      // 0: none is written
  std::uint16_t              Compression = 1;
  std::vector<std::uint64_t> ColourTable;          // all reds, all greens, all blues
  std::vector<std::string>   Blocks;               // the strips' or tiles' bytes
};

/** A classic or a big TIFF file in either byte order, for machines with the least significant byte first. */
class TiffTestFile
{
public:
  explicit TiffTestFile(bool isBigEndian = false, bool isBigTiff = false)
    : m_IsBigEndian(isBigEndian)
    , m_IsBigTiff(isBigTiff)
  {
    m_Bytes = isBigEndian ? "MM" : "II";
    m_Bytes += isBigTiff ? this->Short(43) + this->Short(8) + this->Short(0) : this->Short(42);
    m_Link = m_Bytes.size();
    m_Bytes += this->Offset(0);
  }

  void
  AddPage(const TiffTestPage & page)
  {
    std::vector<std::uint64_t> offsets;
    std::vector<std::uint64_t> counts;
    for (const std::string & block : page.Blocks)
    {
      offsets.push_back(m_Bytes.size());
      counts.push_back(block.size());
      m_Bytes += block;
    }
    std::map<std::uint16_t, std::string> entries;
    this->AddNumbers(entries, 254, 4, { page.SubfileType });
    this->AddNumbers(entries, 256, 4, { page.Width });
    this->AddNumbers(entries, 257, 4, { page.Height });
    this->AddNumbers(entries, 258, 3, std::vector<std::uint64_t>(page.Samples, page.Bits));
    this->AddNumbers(entries, 259, 3, { page.Compression });
    this->AddNumbers(entries, 262, 3, { page.Photometric });
    this->AddNumbers(entries, 277, 3, { page.Samples });
    this->AddNumbers(entries, 284, 3, { page.IsPlanar ? 2u : 1u });
    this->AddNumbers(entries, 339, 3, std::vector<std::uint64_t>(page.Samples, page.Format));
    if (page.TileSize > 0)
    {
      this->AddNumbers(entries, 322, 4, { page.TileSize });
      this->AddNumbers(entries, 323, 4, { page.TileSize });
    }
    else
    {
      this->AddNumbers(entries, 278, 4, { page.RowsPerStrip > 0 ? page.RowsPerStrip : page.Height });
    }
    this->AddNumbers(entries, page.TileSize > 0 ? 324 : 273, 4, offsets);
    this->AddNumbers(entries, page.TileSize > 0 ? 325 : 279, 4, counts);
    if (page.PixelsPerCentimetre > 0)
    {
      this->AddNumbers(entries, 282, 5, { page.PixelsPerCentimetre, 1 });
      this->AddNumbers(entries, 283, 5, { page.PixelsPerCentimetre, 1 });
      this->AddNumbers(entries, 296, 3, { 3 });
    }
    if (page.PixelsPerNothing > 0)
    {
      this->AddNumbers(entries, 282, 5, { page.PixelsPerNothing, 1 });
      this->AddNumbers(entries, 283, 5, { page.PixelsPerNothing, 1 });
      this->AddNumbers(entries, 296, 3, { 1 });
    }
    if (page.Orientation > 0)
    {
      this->AddNumbers(entries, 274, 3, { page.Orientation });
    }
    if (!page.ColourTable.empty())
    {
      this->AddNumbers(entries, 320, 3, page.ColourTable);
    }
    if (!page.Description.empty())
    {
      this->AddEntry(entries, 270, 2, page.Description.size() + 1, page.Description + '\0');
    }
    this->AddDirectory(entries);
  }

  /** A page whose pixels lie in one strip. */
  template <typename T>
  void
  AddPage(TiffTestPage page, const std::vector<T> & pixels)
  {
    page.Bits = 8 * sizeof(T);
    page.Format = std::is_floating_point<T>::value ? 3 : std::is_signed<T>::value ? 2 : 1;
    page.Blocks = { ToBytes(pixels, m_IsBigEndian) };
    this->AddPage(page);
  }

  /** Bytes after all pages. */
  void
  Append(const std::string & bytes)
  {
    m_Bytes += bytes;
  }

  const std::string &
  GetBytes() const
  {
    return m_Bytes;
  }

private:
  std::string
  Short(std::uint16_t number) const
  {
    return ToBytes<std::uint16_t>({ number }, m_IsBigEndian);
  }

  std::string
  Offset(std::uint64_t offset) const
  {
    return m_IsBigTiff ? ToBytes<std::uint64_t>({ offset }, m_IsBigEndian)
                       : ToBytes<std::uint32_t>({ static_cast<std::uint32_t>(offset) }, m_IsBigEndian);
  }

  /** \param type 3 for 16 bits, 4 for 32 bits, 5 for ratios of two numbers of 32 bits */
  void
  AddNumbers(std::map<std::uint16_t, std::string> & entries,
             std::uint16_t                          tag,
             std::uint16_t                          type,
             const std::vector<std::uint64_t> &     numbers)
  {
    std::string bytes;
    for (const std::uint64_t number : numbers)
    {
      bytes += type == 3 ? this->Short(static_cast<std::uint16_t>(number))
                         : ToBytes<std::uint32_t>({ static_cast<std::uint32_t>(number) }, m_IsBigEndian);
    }
    this->AddEntry(entries, tag, type, type == 5 ? numbers.size() / 2 : numbers.size(), bytes);
  }

  void
  AddEntry(std::map<std::uint16_t, std::string> & entries,
           std::uint16_t                          tag,
           std::uint16_t                          type,
           std::uint64_t                          count,
           std::string                            bytes)
  {
    const std::size_t room = m_IsBigTiff ? 8 : 4;
    if (bytes.size() > room)
    {
      const std::uint64_t offset = m_Bytes.size();
      m_Bytes += bytes;
      bytes = this->Offset(offset);
    }
    bytes.resize(room);
    entries[tag] = this->Short(tag) + this->Short(type) + this->Offset(count) + bytes;
  }

  void
  AddDirectory(const std::map<std::uint16_t, std::string> & entries)
  {
    if (m_Bytes.size() % 2 != 0)
    {
      m_Bytes += '\0';
    }
    const std::string here = this->Offset(m_Bytes.size());
    m_Bytes.replace(m_Link, here.size(), here);
    const auto count = static_cast<std::uint16_t>(entries.size());
    m_Bytes += m_IsBigTiff ? ToBytes<std::uint64_t>({ count }, m_IsBigEndian) : this->Short(count);
    for (const auto & entry : entries)
    {
      m_Bytes += entry.second;
    }
    m_Link = m_Bytes.size();
    m_Bytes += this->Offset(0);
  }

  bool        m_IsBigEndian;
  bool        m_IsBigTiff;
  std::string m_Bytes;
  std::size_t m_Link;
};

#endif
