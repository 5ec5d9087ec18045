// SPDX-License-Identifier: Apache-2.0
#include "slices/SliceFolder.h"
#include "slices/SliceFile.h"
#include "slices/SliceNames.h"
#include "tiff/TiffScale.h"
#include "volumes/GridOverrides.h"

#include <algorithm>
#include <stdexcept>

using itk::Subdivision::Box;

namespace
{
class SliceFolder : public VolumeReader
{
public:
  SliceFolder(const std::string & path, const InputOptions & options, const WarningSink & warn)
    : m_Path(path)
    , m_Slices(ListSlices(path, warn))
  {
    if (m_Slices.Files.empty())
    {
      this->Fail("it holds no TIFF, PNG, BMP or JPEG slices");
    }
    const TiffStack stack = this->CheckSlices(warn);
    this->Describe(stack, options, warn);
  }

  std::vector<std::string>
  GetFiles() const override
  {
    return { m_Slices.Files.begin(), m_Slices.Files.end() };
  }

  bool
  ReadsParts() const override
  {
    return true;
  }

  std::uint64_t
  GetScratchBytes(std::uint64_t) const override
  {
    return m_ScratchBytes;
  }

  void
  Read(const Box & box, void * voxels) override;

private:
  [[noreturn]] void
  Fail(const std::string & reason) const
  {
    throw std::runtime_error("cannot read the folder " + m_Path + ": " + reason);
  }

  std::unique_ptr<SliceFile>
  OpenSlice(std::size_t slice) const
  {
    const std::string name = m_Slices.Files[slice].string();
    return m_Slices.Format == "TIFF" ? OpenTiffSlice(name) : OpenPictureSlice(name, m_Slices.Format);
  }

  TiffStack
  CheckSlices(const WarningSink & warn);
  void
  WarnOf(const TiffPage & page, const TiffStack & stack, const WarningSink & warn) const;
  void
  Describe(const TiffStack & stack, const InputOptions & options, const WarningSink & warn);

  std::string   m_Path;
  SliceList     m_Slices;
  TiffPage      m_Page;
  std::uint64_t m_ScratchBytes = 0;
};

/** Reads every header, and returns what the first one says of the spacing. */
TiffStack
SliceFolder::CheckSlices(const WarningSink & warn)
{
  TiffStack stack;
  bool      isScaleTold = false;
  for (std::size_t number = 0; number < m_Slices.Files.size(); ++number)
  {
    const auto slice = this->OpenSlice(number);
    if (number == 0)
    {
      m_Page = slice->GetPage();
      stack = slice->GetStack();
      this->WarnOf(m_Page, stack, warn);
    }
    const TiffPage & page = slice->GetPage();
    if (!page.HasPixelsLike(m_Page) || page.IsInverted != m_Page.IsInverted)
    {
      this->Fail(m_Slices.Files[number].filename().string() + " is " + page.GetText() + ", but " +
                 m_Slices.Files[0].filename().string() + " is " + m_Page.GetText() +
                 (page.IsInverted != m_Page.IsInverted ? " and differs in whether 0 is black" : "") +
                 ": slices of one size and type make a volume");
    }
    if (!page.IsTurnedLike(m_Page))
    {
      this->Fail(m_Slices.Files[number].filename().string() + " asks to be shown in another way (orientation " +
                 std::to_string(page.Orientation) + ") than " + m_Slices.Files[0].filename().string() +
                 " (orientation " + std::to_string(m_Page.Orientation) +
                 "); save all of them turned as they are meant");
    }
    if (slice->GetStack().Spacing != stack.Spacing && !isScaleTold)
    {
      isScaleTold = true;
      warn(m_Slices.Files[number].string() + " has another spacing than the slices before: that of " +
           m_Slices.Files[0].filename().string() + " is taken");
    }
    m_ScratchBytes = std::max(m_ScratchBytes, slice->GetScratchBytes());
  }
  return stack;
}

void
SliceFolder::WarnOf(const TiffPage & page, const TiffStack & stack, const WarningSink & warn) const
{
  if (page.HasColourMap)
  {
    warn("the slices of " + m_Path + " have a colour table for display: their values are read without it");
  }
  if (page.IsInverted)
  {
    warn("the slices of " + m_Path + " have 0 as white: their values are turned round, so that 0 is black");
  }
  if (page.Orientation != ORIENTATION_TOPLEFT)
  {
    warn("the slices of " + m_Path + " ask to be shown turned or flipped (orientation " +
         std::to_string(page.Orientation) + "): their rows are read as they are stored");
  }
  if (stack.HasCalibration)
  {
    warn("the slices of " + m_Path + " have a calibration of their values by ImageJ, which is not applied");
  }
}

void
SliceFolder::Describe(const TiffStack & stack, const InputOptions & options, const WarningSink & warn)
{
  const WarningSink silent = [](const std::string &) {};
  ImageGrid &       grid = m_Description.Grid;
  grid.Size = { m_Page.Width, m_Page.Height, m_Slices.Files.size() };
  grid.Spacing = GetTiffSpacing(stack, m_Path, true, options.Spacing ? silent : warn);
  grid.Origin = { 0.0, 0.0, 0.0 };
  grid.Directions = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  m_Description.Component = m_Page.Component;
  m_Description.NumberOfComponents = m_Page.NumberOfComponents;
  m_Description.Kind = m_Page.Kind;
  m_Description.Format = m_Slices.Format + " folder";
  ApplyOverrides(m_Description, options, warn, stack.Spacing[0].has_value());
}

void
SliceFolder::Read(const Box & box, void * voxels)
{
  const TiffRegion    region = { static_cast<std::uint32_t>(box[0].First),
                                 static_cast<std::uint32_t>(box[1].First),
                                 static_cast<std::uint32_t>(box[0].Size),
                                 static_cast<std::uint32_t>(box[1].Size) };
  const std::uint64_t planeBytes = box[0].Size * box[1].Size * m_Page.GetPixelBytes();
  for (std::uint64_t i = 0; i < box[2].Size; ++i)
  {
    const auto slice = this->OpenSlice(static_cast<std::size_t>(box[2].First) + i);
    if (!slice->GetPage().HasPixelsLike(m_Page))
    {
      this->Fail("its slices have changed since it was opened");
    }
    slice->Read(region, static_cast<char *>(voxels) + i * planeBytes);
  }
}
} // namespace

bool
HoldsSlices(const std::string & path)
{
  try
  {
    return !ListSlices(path, [](const std::string &) {}).Files.empty();
  }
  catch (const std::runtime_error &)
  {
    return true; // there are some, and opening them says what is wrong
  }
}

std::unique_ptr<VolumeReader>
OpenSliceFolder(const std::string & path, const InputOptions & options, const WarningSink & warn)
{
  return std::make_unique<SliceFolder>(path, options, warn);
}
