// SPDX-License-Identifier: Apache-2.0
#include "tiff/TiffReader.h"
#include "system/files/InputFile.h"
#include "tiff/TiffPixels.h"
#include "tiff/TiffScale.h"
#include "volumes/GridOverrides.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

using itk::Subdivision::Box;
using itk::Subdivision::ElementType;

namespace
{
/** ImageJ shows up to seven channels: more of them are a volume that was written without saying what its axes are. */
bool
TakeChannelsForSlices(TiffStack & stack)
{
  constexpr std::uint64_t mostChannels = 7;
  if (!stack.IsImageJ || stack.Slices > 1 || stack.Frames > 1 || stack.Channels <= mostChannels)
  {
    return false;
  }
  std::swap(stack.Slices, stack.Channels);
  return true;
}

class TiffReader : public VolumeReader
{
public:
  TiffReader(const std::string & path, const InputOptions & options, const WarningSink & warn)
    : m_File(path)
    , m_Tiff(path, "rm", path)
  {
    this->ReadPages();
    TiffStack stack = this->MakeStack();
    if (!options.Channel && TakeChannelsForSlices(stack))
    {
      warn(
        path + " has " + std::to_string(stack.Slices) +
        " channels of one slice by its ImageJ description: they are taken for slices, since tifffile writes slices so "
        "unless it is told the axes; --channel takes one of them");
    }
    this->ChoosePlanes(stack, options);
    this->Describe(stack, options, warn);
    this->Warn(stack, warn);
  }

  std::vector<std::string>
  GetFiles() const override
  {
    return { m_File.GetPath() };
  }

  bool
  ReadsParts() const override
  {
    return true;
  }

  std::uint64_t
  GetScratchBytes(std::uint64_t) const override
  {
    return m_LargestStrile;
  }

  void
  Read(const Box & box, void * voxels) override;

private:
  void
  ReadPages();
  void
  ComparePage(const TiffPage & page, const std::string & name);
  TiffStack
  MakeStack();
  void
  CheckContiguousPlanes(std::uint64_t planes);
  void
  ChoosePlanes(const TiffStack & stack, const InputOptions & options);
  void
  Describe(TiffStack & stack, const InputOptions & options, const WarningSink & warn);
  void
  Warn(const TiffStack & stack, const WarningSink & warn) const;
  void
  ReadPage(std::uint64_t plane, const TiffRegion & region, unsigned char * voxels);
  void
  ReadContiguousPlane(std::uint64_t plane, const TiffRegion & region, unsigned char * voxels);

  InputFile                  m_File;
  TiffHandle                 m_Tiff;
  std::vector<std::uint64_t> m_Pages; // offsets of their directories
  TiffPage                   m_First;
  TiffStack                  m_FirstScale; // what the first page's resolution says
  bool                       m_IsInverted = false;
  bool                       m_HasOtherScale = false;
  std::vector<std::uint64_t> m_Slices; // the pages, or contiguous planes, that are read
  bool                       m_IsContiguous = false;
  std::uint64_t              m_DataOffset = 0; // of contiguous planes
  bool                       m_HoldsInt16 = false;
  std::uint64_t              m_LargestStrile = 0;
};

void
TiffReader::ReadPages()
{
  for (std::uint64_t number = 1;; ++number)
  {
    if (!IsThumbnail(m_Tiff))
    {
      const std::string name = "its page " + std::to_string(number);
      const TiffPage    page = DescribeTiffPage(m_Tiff, name, m_File.GetSize());
      this->ComparePage(page, name);
      m_Pages.push_back(TIFFCurrentDirOffset(m_Tiff));
      m_LargestStrile =
        std::max<std::uint64_t>(m_LargestStrile, page.IsTiled ? TIFFTileSize64(m_Tiff) : TIFFStripSize64(m_Tiff));
    }
    CheckTiffDirectory(m_Tiff, m_File);
    if (TIFFLastDirectory(m_Tiff) != 0)
    {
      break;
    }
    if (TIFFReadDirectory(m_Tiff) == 0)
    {
      m_Tiff.Fail("it is damaged after its page " + std::to_string(number));
    }
  }
  if (m_Pages.empty())
  {
    m_Tiff.Fail("it holds thumbnails and masks alone");
  }
  TIFFSetSubDirectory(m_Tiff, m_Pages.front());
}

/** Compares the current page with the first one. */
void
TiffReader::ComparePage(const TiffPage & page, const std::string & name)
{
  TiffStack scale;
  CompleteTiffSpacing(scale, m_Tiff);
  if (m_Pages.empty())
  {
    m_First = page;
    m_FirstScale = scale;
  }
  else if (!page.HasPixelsLike(m_First))
  {
    m_Tiff.Fail(name + " is " + page.GetText() + ", those before are " + m_First.GetText() +
                ": pages of one size and type make a volume");
  }
  else if (page.SaysOrientation && !page.IsTurnedLike(m_First)) // some programs say it once for all pages
  {
    m_Tiff.Fail(name + " asks to be shown in another way (orientation " + std::to_string(page.Orientation) +
                ") than those before (orientation " + std::to_string(m_First.Orientation) +
                "); save all of them turned as they are meant");
  }
  m_IsInverted = m_IsInverted || page.IsInverted;
  m_HasOtherScale = m_HasOtherScale || (scale.Spacing[0] && scale.Spacing != m_FirstScale.Spacing);
}

/** The planes as the file's description orders them. */
TiffStack
TiffReader::MakeStack()
{
  const std::string        text = GetTiffDescription(m_Tiff);
  std::optional<TiffStack> stack;
  try
  {
    stack = ParseImageJ(text);
    stack = stack ? stack : ParseOme(text, m_Pages.size());
  }
  catch (const std::runtime_error & error)
  {
    m_Tiff.Fail(error.what());
  }
  const bool isShaped = text.compare(0, 1, "{") == 0 && text.find("\"shape\"") != std::string::npos;
  if (isShaped && text.find("\"truncated\": true") != std::string::npos)
  {
    m_Tiff.Fail("it holds several slices in one page, as tifffile writes it with truncate=True; write it without that");
  }
  if (stack && stack->IsImageJ && stack->Planes.size() != m_Pages.size())
  {
    this->CheckContiguousPlanes(stack->Planes.size());
  }
  if (!stack)
  {
    stack.emplace();
    stack->Slices = m_Pages.size();
    stack->Planes.resize(m_Pages.size());
    std::iota(stack->Planes.begin(), stack->Planes.end(), 0);
  }
  return *stack;
}

/** ImageJ writes one page alone above 4 GiB: the planes follow that page's one after the other. */
void
TiffReader::CheckContiguousPlanes(std::uint64_t planes)
{
  if (m_Pages.size() != 1)
  {
    m_Tiff.Fail("its ImageJ description counts " + std::to_string(planes) + " images, but it has " +
                std::to_string(m_Pages.size()) + " pages: it is truncated, or pages were taken out");
  }
  const std::uint64_t planeBytes =
    m_First.Bits / 8 * std::uint64_t{ m_First.NumberOfComponents } * m_First.Width * m_First.Height;
  m_DataOffset = TIFFGetStrileOffset(m_Tiff, 0);
  std::uint64_t end = m_DataOffset;
  bool          isOnePiece = !m_First.IsCompressed && !m_First.IsTiled && !m_First.IsPlanar && m_First.Bits % 8 == 0;
  for (std::uint32_t strip = 0; isOnePiece && strip < TIFFNumberOfStrips(m_Tiff); ++strip)
  {
    isOnePiece = TIFFGetStrileOffset(m_Tiff, strip) == end;
    end += TIFFGetStrileByteCount(m_Tiff, strip);
  }
  if (!isOnePiece)
  {
    m_Tiff.Fail("its ImageJ description counts " + std::to_string(planes) + " images, but it has one page");
  }
  if (planeBytes > (m_File.GetSize() - m_DataOffset) / planes)
  {
    m_Tiff.Fail("it is truncated: its ImageJ description counts " + std::to_string(planes) + " images of " +
                std::to_string(planeBytes) + " bytes, but " + std::to_string(m_File.GetSize() - m_DataOffset) +
                " bytes are there");
  }
  m_IsContiguous = true;
}

std::uint64_t
Choose(const TiffHandle &                  tiff,
       const char *                        what,
       const char *                        option,
       std::uint64_t                       count,
       const std::optional<unsigned int> & chosen)
{
  if (count > 1 && !chosen)
  {
    tiff.Fail("it has " + std::to_string(count) + ' ' + what + "s: choose one by " + option + " 0 to " +
              std::to_string(count - 1));
  }
  if (chosen.value_or(0) >= count)
  {
    tiff.Fail(std::string("it has no ") + what + ' ' + std::to_string(*chosen) + ": there " +
              (count == 1 ? "is 1, number 0" : "are " + std::to_string(count) + ", numbered from 0"));
  }
  return chosen.value_or(0);
}

void
TiffReader::ChoosePlanes(const TiffStack & stack, const InputOptions & options)
{
  const std::uint64_t channel = Choose(m_Tiff, "channel", "--channel", stack.Channels, options.Channel);
  const std::uint64_t frame = Choose(m_Tiff, "frame", "--frame", stack.Frames, options.Frame);
  for (std::uint64_t slice = 0; slice < stack.Slices; ++slice)
  {
    m_Slices.push_back(stack.Planes[(frame * stack.Slices + slice) * stack.Channels + channel]);
  }
}

void
TiffReader::Describe(TiffStack & stack, const InputOptions & options, const WarningSink & warn)
{
  const bool isVolume = m_Slices.size() > 1;
  const bool isInDescription = stack.Spacing[0].has_value();
  CompleteTiffSpacing(stack, m_Tiff);
  m_HoldsInt16 = stack.HoldsInt16 && m_First.Component == ElementType::UInt16;

  ImageGrid & grid = m_Description.Grid;
  grid.Size = { m_First.Width, m_First.Height };
  if (isVolume)
  {
    grid.Size.push_back(m_Slices.size());
  }
  const WarningSink silent = [](const std::string &) {};
  grid.Spacing = GetTiffSpacing(stack, m_Tiff.GetName(), isVolume, options.Spacing ? silent : warn);
  if (m_HasOtherScale && !isInDescription && !options.Spacing)
  {
    warn(m_Tiff.GetName() + " has pages of other resolutions than the first one, whose resolution is taken for all");
  }
  grid.Origin.assign(grid.Size.size(), 0.0);
  for (std::size_t axis = 0; axis < grid.Size.size(); ++axis)
  {
    grid.Directions.emplace_back(grid.Size.size(), 0.0);
    grid.Directions.back()[axis] = 1.0;
  }
  m_Description.Component = m_HoldsInt16 ? ElementType::Int16 : m_First.Component;
  m_Description.NumberOfComponents = m_First.NumberOfComponents;
  m_Description.Kind = m_First.Kind;
  m_Description.Format = "TIFF";
  const bool saysSpacing = stack.Spacing[0].has_value() || stack.Spacing[2].has_value();
  ApplyOverrides(m_Description, options, warn, saysSpacing);
}

void
TiffReader::Warn(const TiffStack & stack, const WarningSink & warn) const
{
  const std::string & name = m_Tiff.GetName();
  if (m_First.HasColourMap && !stack.IsImageJ)
  {
    m_Tiff.Fail("its values are entries of a colour table; convert it to grey values or RGB");
  }
  if (m_First.HasColourMap)
  {
    warn(name + " has a colour table for display: its values are read without it");
  }
  if (m_IsInverted)
  {
    warn(name + " has 0 as white: its values are turned round, so that 0 is black");
  }
  if (m_First.Orientation != ORIENTATION_TOPLEFT)
  {
    warn(name + " asks to be shown turned or flipped (orientation " + std::to_string(m_First.Orientation) +
         "): its rows are read as they are stored");
  }
  if (stack.HasCalibration)
  {
    warn(name + " has a calibration of its values by ImageJ, which is not applied");
  }
  for (const std::string & warning : m_Tiff.GetWarnings())
  {
    warn(name + ": " + warning);
  }
}

void
TiffReader::Read(const Box & box, void * voxels)
{
  const TiffRegion    region = { static_cast<std::uint32_t>(box[0].First),
                                 static_cast<std::uint32_t>(box[1].First),
                                 static_cast<std::uint32_t>(box[0].Size),
                                 static_cast<std::uint32_t>(box[1].Size) };
  const std::uint64_t planeVoxels = box[0].Size * box[1].Size;
  const std::uint64_t first = box.size() > 2 ? static_cast<std::uint64_t>(box[2].First) : 0;
  const std::uint64_t count = box.size() > 2 ? box[2].Size : 1;
  for (std::uint64_t i = 0; i < count; ++i)
  {
    unsigned char * const plane = static_cast<unsigned char *>(voxels) + i * planeVoxels * m_First.GetPixelBytes();
    if (m_IsContiguous)
    {
      this->ReadContiguousPlane(m_Slices[first + i], region, plane);
    }
    else
    {
      this->ReadPage(m_Slices[first + i], region, plane);
    }
  }
  if (m_HoldsInt16)
  {
    auto * const values = static_cast<std::uint16_t *>(voxels);
    std::transform(values, values + planeVoxels * count * m_First.NumberOfComponents, values, [](std::uint16_t value) {
      return static_cast<std::uint16_t>(value ^ 0x8000);
    });
  }
}

void
TiffReader::ReadPage(std::uint64_t plane, const TiffRegion & region, unsigned char * voxels)
{
  if (TIFFCurrentDirOffset(m_Tiff) != m_Pages[plane] && TIFFSetSubDirectory(m_Tiff, m_Pages[plane]) == 0)
  {
    m_Tiff.Fail("it has changed since it was opened");
  }
  // Pages may be stored in different ways.
  const TiffPage page = DescribeTiffPage(m_Tiff, "a page of it", m_File.GetSize());
  if (!page.HasPixelsLike(m_First))
  {
    m_Tiff.Fail("it has changed since it was opened");
  }
  ReadTiffPixels(m_Tiff, page, region, voxels);
}

void
TiffReader::ReadContiguousPlane(std::uint64_t plane, const TiffRegion & region, unsigned char * voxels)
{
  const std::uint64_t        componentBytes = m_First.Bits / 8;
  const std::uint64_t        pixelBytes = componentBytes * m_First.NumberOfComponents;
  const std::uint64_t        rowComponents = std::uint64_t{ region.Width } * m_First.NumberOfComponents;
  std::vector<unsigned char> row(rowComponents * componentBytes);
  for (std::uint64_t y = 0; y < region.Height; ++y)
  {
    const std::uint64_t pixel = (plane * m_First.Height + region.Y + y) * m_First.Width + region.X;
    m_File.ReadAt(m_DataOffset + pixel * pixelBytes, row.data(), row.size());
    if (TIFFIsByteSwapped(m_Tiff) != 0)
    {
      for (std::size_t i = 0; i < row.size(); i += componentBytes)
      {
        std::reverse(row.begin() + static_cast<std::ptrdiff_t>(i),
                     row.begin() + static_cast<std::ptrdiff_t>(i + componentBytes));
      }
    }
    ConvertTiffComponents(
      m_First, row.data(), 0, rowComponents, 1, voxels + y * region.Width * m_First.GetPixelBytes());
  }
}
} // namespace

std::unique_ptr<VolumeReader>
OpenTiff(const std::string & path, const InputOptions & options, const WarningSink & warn)
{
  return std::make_unique<TiffReader>(path, options, warn);
}
