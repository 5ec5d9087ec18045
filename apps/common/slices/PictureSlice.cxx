// SPDX-License-Identifier: Apache-2.0
#include "itk/Bitmap.h"
#include "itk/FileLength.h"
#include "itk/JpegIntegrity.h"
#include "itk/JpegOrientation.h"
#include "itk/LibraryReason.h"
#include "itk/PictureColours.h"
#include "slices/SliceFile.h"
#include "system/files/InputFile.h"

#include "itkJPEGImageIO.h"
#include "itkPNGImageIO.h"

#include <cstring>
#include <stdexcept>
#include <vector>

namespace
{
itk::ImageIOBase::Pointer
ReadHeader(const std::string & path, const std::string & format)
{
  if (format == "BMP")
  {
    return OpenBitmap(path);
  }
  itk::ImageIOBase::Pointer imageIO = format == "PNG" ? itk::ImageIOBase::Pointer(itk::PNGImageIO::New())
                                                      : itk::ImageIOBase::Pointer(itk::JPEGImageIO::New());
  imageIO->SetFileName(path);
  imageIO->ReadImageInformation();
  return imageIO;
}

/** A slice in a format that ITK reads whole. */
class PictureSlice : public SliceFile
{
public:
  PictureSlice(const std::string & path, const std::string & format)
    : m_Path(path)
  {
    this->CheckEnds(format);
    try
    {
      m_ImageIO = ReadHeader(path, format);
    }
    catch (const std::exception & error)
    {
      this->Fail("it is no " + format + " file, or it is damaged (" + GetReason(error) + ')');
    }
    const std::string colourFault = FindColourFault(*m_ImageIO);
    if (!colourFault.empty())
    {
      this->Fail(colourFault);
    }
    m_Page.Width = static_cast<std::uint32_t>(m_ImageIO->GetDimensions(0));
    m_Page.Height = static_cast<std::uint32_t>(m_ImageIO->GetDimensions(1));
    m_Page.NumberOfComponents = m_ImageIO->GetNumberOfComponents();
    m_Page.Component =
      m_ImageIO->GetComponentSize() == 2 ? itk::Subdivision::ElementType::UInt16 : itk::Subdivision::ElementType::UInt8;
    const VoxelKind kinds[] = { VoxelKind::Scalar, VoxelKind::Vector, VoxelKind::Rgb, VoxelKind::Rgba };
    if (m_Page.NumberOfComponents < 1 || m_Page.NumberOfComponents > 4 || m_ImageIO->GetComponentSize() > 2)
    {
      this->Fail("its pixels are of a kind that is not supported");
    }
    m_Page.Kind = kinds[m_Page.NumberOfComponents - 1];
    m_Page.Orientation = ReadJpegOrientation(path);
  }

  const TiffPage &
  GetPage() const override
  {
    return m_Page;
  }

  TiffStack
  GetStack() const override
  {
    return {};
  }

  std::uint64_t
  GetScratchBytes() const override
  {
    return std::uint64_t{ m_Page.Width } * m_Page.Height * m_Page.GetPixelBytes();
  }

  void
  Read(const TiffRegion & region, void * pixels) override
  {
    const std::string fault = FindJpegFault(m_Path);
    if (!fault.empty())
    {
      this->Fail("it is damaged (" + fault + ')');
    }
    std::vector<char>  whole(static_cast<std::size_t>(this->GetScratchBytes()));
    itk::ImageIORegion all(2);
    all.SetSize(0, m_Page.Width);
    all.SetSize(1, m_Page.Height);
    m_ImageIO->SetIORegion(all);
    try
    {
      m_ImageIO->Read(whole.data());
    }
    catch (const std::exception & error)
    {
      this->Fail("it is damaged (" + GetReason(error) + ')');
    }
    const std::uint64_t pixelBytes = m_Page.GetPixelBytes();
    for (std::uint64_t y = 0; y < region.Height; ++y)
    {
      std::memcpy(static_cast<char *>(pixels) + y * region.Width * pixelBytes,
                  whole.data() + ((region.Y + y) * m_Page.Width + region.X) * pixelBytes,
                  region.Width * pixelBytes);
    }
  }

private:
  [[noreturn]] void
  Fail(const std::string & reason) const
  {
    throw std::runtime_error("cannot read " + m_Path + ": " + reason);
  }

  /** The libraries for PNG and JPEG end the program at the end of a truncated file. */
  void
  CheckEnds(const std::string & format) const
  {
    if (format == "BMP")
    {
      CheckBmpLength(m_Path);
      return;
    }
    const InputFile     file(m_Path);
    const std::uint64_t tail = std::min<std::uint64_t>(file.GetSize(), 4096);
    const std::string   end = file.ReadTextAt(file.GetSize() - tail, tail);
    const char * const  sign = format == "PNG" ? "IEND" : "\xFF\xD9";
    if (end.find(sign) == std::string::npos)
    {
      this->Fail("it is truncated");
    }
  }

  std::string               m_Path;
  itk::ImageIOBase::Pointer m_ImageIO;
  TiffPage                  m_Page;
};
} // namespace

std::unique_ptr<SliceFile>
OpenPictureSlice(const std::string & path, const std::string & format)
{
  return std::make_unique<PictureSlice>(path, format);
}
