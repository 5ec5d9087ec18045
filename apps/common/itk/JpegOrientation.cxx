// SPDX-License-Identifier: Apache-2.0
#include "itk/JpegOrientation.h"
#include "system/files/InputFile.h"

#include <optional>

namespace
{
/** Numbers of a text in either byte order. What is beyond its end is 0. */
class Numbers
{
public:
  Numbers(const std::string & text, bool isBigEndian)
    : m_Text(text)
    , m_IsBigEndian(isBigEndian)
  {}

  std::uint64_t
  Get(std::uint64_t place, std::uint64_t bytes) const
  {
    std::uint64_t number = 0;
    for (std::uint64_t i = 0; i < bytes && place + bytes <= m_Text.size(); ++i)
    {
      number = 256 * number + static_cast<unsigned char>(m_Text[place + (m_IsBigEndian ? i : bytes - 1 - i)]);
    }
    return number;
  }

private:
  const std::string & m_Text;
  const bool          m_IsBigEndian;
};

/** The content of the segment with Exif data, which is that of a TIFF file. */
std::optional<std::string>
FindExif(const InputFile & file)
{
  const std::string start("Exif\0\0", 6);
  if (file.ReadTextAt(0, 2) != "\xFF\xD8")
  {
    return std::nullopt;
  }
  for (std::uint64_t place = 2;;)
  {
    const std::string   head = file.ReadTextAt(place, 10);
    const std::uint64_t length = Numbers(head, true).Get(2, 2);
    const std::uint64_t marker = Numbers(head, true).Get(0, 2);
    constexpr unsigned  startOfScan = 0xffda;
    constexpr unsigned  application1 = 0xffe1;
    if (marker < 0xff01 || marker == startOfScan || length < 2)
    {
      return std::nullopt;
    }
    if (marker == application1 && length >= 8 && head.compare(4, 6, start) == 0)
    {
      return file.ReadTextAt(place + 10, length - 8);
    }
    place += 2 + length;
  }
}
} // namespace

std::uint16_t
ReadJpegOrientation(const std::string & path)
{
  const auto exif = FindExif(InputFile(path));
  if (!exif)
  {
    return 1;
  }
  const Numbers       numbers(*exif, exif->compare(0, 2, "MM") == 0);
  const std::uint64_t directory = numbers.Get(4, 4);
  const std::uint64_t entries = numbers.Get(directory, 2);
  for (std::uint64_t i = 0; i < entries; ++i)
  {
    constexpr unsigned  orientationTag = 0x112;
    constexpr unsigned  shortType = 3;
    const std::uint64_t entry = directory + 2 + 12 * i;
    const std::uint64_t value = numbers.Get(entry + 8, 2);
    if (numbers.Get(entry, 2) == orientationTag && numbers.Get(entry + 2, 2) == shortType && value >= 1 && value <= 8)
    {
      return static_cast<std::uint16_t>(value);
    }
  }
  return 1;
}
