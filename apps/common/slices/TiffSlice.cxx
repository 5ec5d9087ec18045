// SPDX-License-Identifier: Apache-2.0
#include "slices/SliceFile.h"
#include "system/files/InputFile.h"
#include "tiff/TiffScale.h"

#include <stdexcept>

namespace
{
class TiffSlice : public SliceFile
{
public:
  explicit TiffSlice(const std::string & path)
    : m_File(path)
    , m_Tiff(path, "rm", path)
  {
    this->FindPage();
    m_Stack.IsImageJ = false;
    const std::string text = GetTiffDescription(m_Tiff);
    try
    {
      if (const auto imageJ = ParseImageJ(text))
      {
        m_Stack = *imageJ;
      }
    }
    catch (const std::runtime_error & error)
    {
      m_Tiff.Fail(error.what());
    }
    if (m_Stack.Planes.size() > 1)
    {
      m_Tiff.Fail("it holds several images, but stands in a folder of slices; open it by itself");
    }
    CompleteTiffSpacing(m_Stack, m_Tiff);
    if (m_Page.HasColourMap && !m_Stack.IsImageJ)
    {
      m_Tiff.Fail("its values are entries of a colour table; convert it to grey values or RGB");
    }
    if (m_Stack.HoldsInt16 && m_Page.Component == itk::Subdivision::ElementType::UInt16)
    {
      m_IsOffset = true;
      m_Page.Component = itk::Subdivision::ElementType::Int16;
    }
  }

  const TiffPage &
  GetPage() const override
  {
    return m_Page;
  }

  TiffStack
  GetStack() const override
  {
    return m_Stack;
  }

  std::uint64_t
  GetScratchBytes() const override
  {
    return m_Page.IsTiled ? TIFFTileSize64(m_Tiff) : TIFFStripSize64(m_Tiff);
  }

  void
  Read(const TiffRegion & region, void * pixels) override
  {
    ReadTiffPixels(m_Tiff, m_Page, region, pixels);
    auto * const        values = static_cast<std::uint16_t *>(pixels);
    const std::uint64_t count = std::uint64_t{ region.Width } * region.Height * m_Page.NumberOfComponents;
    for (std::uint64_t i = 0; m_IsOffset && i < count; ++i)
    {
      values[i] ^= 0x8000;
    }
  }

private:
  /** The only page but for thumbnails becomes the current one. */
  void
  FindPage()
  {
    std::uint64_t offset = 0;
    for (;;)
    {
      if (!IsThumbnail(m_Tiff))
      {
        if (offset != 0)
        {
          m_Tiff.Fail("it has several pages, but stands in a folder of slices; open it by itself");
        }
        offset = TIFFCurrentDirOffset(m_Tiff);
        m_Page = DescribeTiffPage(m_Tiff, "its page", m_File.GetSize());
      }
      CheckTiffDirectory(m_Tiff, m_File);
      if (TIFFLastDirectory(m_Tiff) != 0)
      {
        break;
      }
      if (TIFFReadDirectory(m_Tiff) == 0)
      {
        m_Tiff.Fail("it is damaged after its first page");
      }
    }
    if (offset == 0)
    {
      m_Tiff.Fail("it holds a thumbnail or a mask alone");
    }
    if (TIFFCurrentDirOffset(m_Tiff) != offset)
    {
      TIFFSetSubDirectory(m_Tiff, offset);
    }
  }

  InputFile  m_File;
  TiffHandle m_Tiff;
  TiffPage   m_Page;
  TiffStack  m_Stack;
  bool       m_IsOffset = false;
};
} // namespace

std::unique_ptr<SliceFile>
OpenTiffSlice(const std::string & path)
{
  return std::make_unique<TiffSlice>(path);
}
