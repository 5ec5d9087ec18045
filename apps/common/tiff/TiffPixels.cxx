// SPDX-License-Identifier: Apache-2.0
#include "tiff/TiffPixels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

using itk::Subdivision::WithElementType;

namespace
{
float
FromHalf(std::uint16_t half)
{
  const int   exponent = (half >> 10) & 31;
  const float mantissa = static_cast<float>(half & 1023);
  float       value = 0.0f;
  if (exponent == 31)
  {
    value = mantissa == 0.0f ? std::numeric_limits<float>::infinity() : std::numeric_limits<float>::quiet_NaN();
  }
  else
  {
    value = exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(mantissa + 1024.0f, exponent - 25);
  }
  return (half & 0x8000) != 0 ? -value : value;
}

/** The number that lies in some bits of a row, the most significant bit first. */
std::uint32_t
UnpackBits(const unsigned char * row, std::uint64_t bit, unsigned int bits)
{
  std::uint32_t value = 0;
  for (unsigned int i = 0; i < bits; ++i, ++bit)
  {
    value = 2 * value + ((row[bit / 8] >> (7 - bit % 8)) & 1);
  }
  return value;
}

/** One component of a row as it is stored, less the order of bytes. */
template <typename T>
T
GetComponent(const TiffPage & page, const unsigned char * row, std::uint64_t index)
{
  if (page.Bits < 8 * sizeof(T) && !page.IsHalf)
  {
    const std::uint32_t value = UnpackBits(row, index * page.Bits, page.Bits);
    return static_cast<T>(page.Bits == 1 ? 255 * value : value);
  }
  if (page.IsHalf)
  {
    std::uint16_t half = 0;
    std::memcpy(&half, row + 2 * index, 2);
    return static_cast<T>(FromHalf(half));
  }
  T value{};
  std::memcpy(&value, row + sizeof(T) * index, sizeof(T));
  return value;
}

template <typename T>
T
GetWhite(const TiffPage & page)
{
  if constexpr (std::is_floating_point<T>::value)
  {
    return 0; // such pages are refused
  }
  else
  {
    const bool isPacked = page.Bits != 1 && page.Bits < 8 * sizeof(T);
    return isPacked ? static_cast<T>((1u << page.Bits) - 1) : std::numeric_limits<T>::max();
  }
}

/** Reads the strips or tiles of a page, each once. */
class StrileReader
{
public:
  StrileReader(const TiffHandle & tiff, const TiffPage & page, const TiffRegion & region, void * pixels)
    : m_Tiff(tiff)
    , m_Page(page)
    , m_Region(region)
    , m_Pixels(static_cast<unsigned char *>(pixels))
    , m_StrileWidth(page.Width)
    , m_StrileHeight(page.Height)
  {
    std::uint16_t photometric = 0;
    TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
    if (photometric == PHOTOMETRIC_YCBCR)
    {
      TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
    }
    if (page.IsTiled)
    {
      TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &m_StrileWidth);
      TIFFGetField(tiff, TIFFTAG_TILELENGTH, &m_StrileHeight);
    }
    else
    {
      TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &m_StrileHeight);
      m_StrileHeight = std::min(m_StrileHeight, page.Height);
    }
    m_Strile.resize(static_cast<std::size_t>(page.IsTiled ? TIFFTileSize64(tiff) : TIFFStripSize64(tiff)));
  }

  void
  Read()
  {
    const unsigned int planes = m_Page.IsPlanar ? m_Page.NumberOfComponents : 1;
    for (unsigned int plane = 0; plane < planes; ++plane)
    {
      for (std::uint64_t y = m_Region.Y - m_Region.Y % m_StrileHeight;
           y < m_Region.Y + std::uint64_t{ m_Region.Height };
           y += m_StrileHeight)
      {
        for (std::uint64_t x = m_Region.X - m_Region.X % m_StrileWidth;
             x < m_Region.X + std::uint64_t{ m_Region.Width };
             x += m_StrileWidth)
        {
          this->Decode(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), plane);
          this->Copy(x, y, plane);
        }
      }
    }
  }

private:
  void
  Decode(std::uint32_t x, std::uint32_t y, unsigned int plane)
  {
    const auto sample = static_cast<std::uint16_t>(plane);
    const auto size = static_cast<tmsize_t>(m_Strile.size());
    tmsize_t   read = -1;
    tmsize_t   expected = size;
    if (m_Page.IsTiled)
    {
      read = TIFFReadEncodedTile(m_Tiff, TIFFComputeTile(m_Tiff, x, y, 0, sample), m_Strile.data(), size);
    }
    else
    {
      expected = TIFFVStripSize(m_Tiff, std::min(m_StrileHeight, m_Page.Height - y));
      read = TIFFReadEncodedStrip(m_Tiff, TIFFComputeStrip(m_Tiff, y, sample), m_Strile.data(), expected);
    }
    if (read != expected)
    {
      m_Tiff.Fail("it is damaged, its pixels cannot be decoded");
    }
  }

  /** Copies what is asked for of the strip or tile at a place. */
  void
  Copy(std::uint64_t x, std::uint64_t y, unsigned int plane)
  {
    const std::uint64_t rowBytes = m_Strile.size() / m_StrileHeight;
    const std::uint64_t left = std::max<std::uint64_t>(x, m_Region.X);
    const std::uint64_t right = std::min(x + m_StrileWidth, std::uint64_t{ m_Region.X } + m_Region.Width);
    const std::uint64_t top = std::max<std::uint64_t>(y, m_Region.Y);
    const std::uint64_t bottom = std::min(y + m_StrileHeight, std::uint64_t{ m_Region.Y } + m_Region.Height);
    const std::uint64_t inPlane = m_Page.IsPlanar ? 1 : m_Page.NumberOfComponents;
    const std::uint64_t stride = m_Page.IsPlanar ? m_Page.NumberOfComponents : 1;
    for (std::uint64_t row = top; row < bottom; ++row)
    {
      unsigned char * const pixels =
        m_Pixels + ((row - m_Region.Y) * m_Region.Width + left - m_Region.X) * m_Page.GetPixelBytes() +
        plane * itk::Subdivision::SizeOf(m_Page.Component);
      ConvertTiffComponents(
        m_Page, m_Strile.data() + (row - y) * rowBytes, (left - x) * inPlane, (right - left) * inPlane, stride, pixels);
    }
  }

  const TiffHandle &         m_Tiff;
  const TiffPage &           m_Page;
  const TiffRegion &         m_Region;
  unsigned char *            m_Pixels;
  std::uint32_t              m_StrileWidth;
  std::uint32_t              m_StrileHeight;
  std::vector<unsigned char> m_Strile;
};
} // namespace

void
ConvertTiffComponents(const TiffPage & page,
                      const void *     stored,
                      std::uint64_t    first,
                      std::uint64_t    count,
                      std::uint64_t    stride,
                      void *           components)
{
  WithElementType(page.Component, [&](auto tag) {
    using T = typename decltype(tag)::Type;
    const auto * row = static_cast<const unsigned char *>(stored);
    auto *       to = static_cast<unsigned char *>(components);
    const T      white = GetWhite<T>(page);
    if (page.Bits == 8 * sizeof(T) && !page.IsInverted && stride == 1)
    {
      std::memcpy(to, row + first * sizeof(T), count * sizeof(T));
      return;
    }
    for (std::uint64_t i = 0; i < count; ++i)
    {
      const T value = GetComponent<T>(page, row, first + i);
      const T seen = page.IsInverted ? static_cast<T>(white - value) : value;
      std::memcpy(to + i * stride * sizeof(T), &seen, sizeof(T));
    }
  });
}

void
ReadTiffPixels(const TiffHandle & tiff, const TiffPage & page, const TiffRegion & region, void * pixels)
{
  StrileReader(tiff, page, region, pixels).Read();
}
