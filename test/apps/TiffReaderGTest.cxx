// SPDX-License-Identifier: Apache-2.0
#include "TestFolder.h"
#include "TiffTestFile.h"
#include "VolumeTestAccess.h"
#include "tiff/TiffReader.h"

#include <cmath>
#include <gtest/gtest.h>

using itk::Subdivision::Box;
using itk::Subdivision::ElementType;

namespace
{
class TiffReaderTest : public ::testing::Test
{
protected:
  std::unique_ptr<VolumeReader>
  Open(const std::string & bytes, const InputOptions & options = {})
  {
    m_Folder.WriteFile("a.tif", bytes);
    return OpenTiff(m_Folder / "a.tif", options, m_Warnings.GetSink());
  }

  std::string
  GetOpeningError(const std::string & bytes, const InputOptions & options = {})
  {
    return GetError([&] { this->Open(bytes, options); });
  }

  TestFolder   m_Folder;
  KeptWarnings m_Warnings;
};

/** Pages of 5 x 3 pixels. */
template <typename T>
TiffTestFile
MakeStack(const std::vector<T> & voxels, const std::string & text, bool isBigEndian = false, bool isBigTiff = false)
{
  TiffTestFile file(isBigEndian, isBigTiff);
  TiffTestPage page;
  page.Width = 5;
  page.Height = 3;
  page.Description = text;
  for (std::size_t first = 0; first < voxels.size(); first += 15)
  {
    file.AddPage(page, std::vector<T>(voxels.begin() + first, voxels.begin() + first + 15));
    page.Description.clear();
  }
  return file;
}

InputOptions
Choose(unsigned int channel, unsigned int frame)
{
  InputOptions options;
  options.Channel = channel;
  options.Frame = frame;
  return options;
}
} // namespace

template <typename T>
class TiffReaderTypeTest : public TiffReaderTest
{};
using ElementTypes = ::testing::Types<std::uint8_t,
                                      std::int8_t,
                                      std::uint16_t,
                                      std::int16_t,
                                      std::uint32_t,
                                      std::int32_t,
                                      std::uint64_t,
                                      std::int64_t,
                                      float,
                                      double>;
TYPED_TEST_SUITE(TiffReaderTypeTest, ElementTypes);

TYPED_TEST(TiffReaderTypeTest, GivesEveryTypeInEitherOrderOfBytes)
{
  const auto voxels = MakeVoxels<TypeParam>(4 * 15);
  for (const bool isBigEndian : { false, true })
  {
    for (const bool isBigTiff : { false, true })
    {
      const auto reader = this->Open(MakeStack(voxels, "", isBigEndian, isBigTiff).GetBytes());
      EXPECT_EQ(reader->GetDescription().Component, itk::Subdivision::ElementTypeOf<TypeParam>());
      EXPECT_EQ(reader->GetDescription().Grid.Size, (std::vector<std::uint64_t>{ 5, 3, 4 }));
      EXPECT_EQ(ReadAll<TypeParam>(*reader), voxels);
      const std::vector<TypeParam> part = { voxels[36], voxels[37], voxels[41], voxels[42],
                                            voxels[51], voxels[52], voxels[56], voxels[57] };
      EXPECT_EQ(ReadBox<TypeParam>(*reader, Box{ { 1, 2 }, { 1, 2 }, { 2, 2 } }), part);
    }
  }
}

TEST_F(TiffReaderTest, PutsTilesTogether)
{
  TiffTestPage page;
  page.Width = 20;
  page.Height = 18;
  page.Bits = 16;
  page.TileSize = 16;
  const auto pixels = MakeVoxels<std::uint16_t>(20 * 18);
  for (const std::size_t y : { 0, 16 })
  {
    for (const std::size_t x : { 0, 16 })
    {
      std::vector<std::uint16_t> tile(16 * 16, 9999);
      for (std::size_t i = 0; i < 256; ++i)
      {
        if (x + i % 16 < 20 && y + i / 16 < 18)
        {
          tile[i] = pixels[(y + i / 16) * 20 + x + i % 16];
        }
      }
      page.Blocks.push_back(ToBytes(tile, false));
    }
  }
  TiffTestFile file;
  file.AddPage(page);
  const auto reader = this->Open(file.GetBytes());
  EXPECT_EQ(reader->GetDescription().Grid.Size, (std::vector<std::uint64_t>{ 20, 18 }));
  EXPECT_EQ(ReadAll<std::uint16_t>(*reader), pixels);
  EXPECT_EQ(ReadBox<std::uint16_t>(*reader, Box{ { 15, 2 }, { 15, 2 } }),
            (std::vector<std::uint16_t>{ pixels[315], pixels[316], pixels[335], pixels[336] }));
}

TEST_F(TiffReaderTest, PutsPlanesOfColoursTogether)
{
  TiffTestPage page;
  page.Width = 2;
  page.Height = 2;
  page.Samples = 3;
  page.Photometric = 2;
  page.IsPlanar = true;
  page.RowsPerStrip = 1;
  page.Blocks = { "ab", "cd", "ef", "gh", "ij", "kl" };
  TiffTestFile file;
  file.AddPage(page);
  const auto reader = this->Open(file.GetBytes());
  EXPECT_EQ(reader->GetDescription().Kind, VoxelKind::Rgb);
  const auto        voxels = ReadAll<char>(*reader);
  const std::string text(voxels.begin(), voxels.end());
  EXPECT_EQ(text, "aeibfjcgkdhl");
}

TEST_F(TiffReaderTest, UnpacksBits)
{
  TiffTestPage page;
  page.Width = 10;
  page.Height = 2;
  page.Bits = 1;
  page.Blocks = { std::string("\xC0\x40\x00\x80", 4) };
  TiffTestFile black;
  black.AddPage(page);
  std::vector<std::uint8_t> pixels = { 255, 255, 0, 0, 0, 0, 0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0, 255, 0 };
  EXPECT_EQ(ReadAll<std::uint8_t>(*this->Open(black.GetBytes())), pixels);
  EXPECT_EQ(m_Warnings.GetNumber(), 0u);

  page.Photometric = 0;
  TiffTestFile white;
  white.AddPage(page);
  std::transform(pixels.begin(), pixels.end(), pixels.begin(), [](std::uint8_t value) { return 255 - value; });
  EXPECT_EQ(ReadAll<std::uint8_t>(*this->Open(white.GetBytes())), pixels);
  EXPECT_TRUE(m_Warnings.Mention("0 as white"));

  page.Photometric = 1;
  page.Bits = 12;
  page.Width = 2;
  page.Height = 1;
  page.Blocks = { "\x12\x3F\xED" };
  TiffTestFile packed;
  packed.AddPage(page);
  EXPECT_EQ(ReadAll<std::uint16_t>(*this->Open(packed.GetBytes())), (std::vector<std::uint16_t>{ 0x123, 0xFED }));
}

TEST_F(TiffReaderTest, MakesFloatOfHalf)
{
  TiffTestPage page;
  page.Width = 6;
  page.Height = 1;
  page.Bits = 16;
  page.Format = 3;
  for (const bool isBigEndian : { false, true })
  {
    page.Blocks = { ToBytes<std::uint16_t>({ 0x3C00, 0xC000, 0x7BFF, 0x0001, 0x3555, 0xFC00 }, isBigEndian) };
    TiffTestFile file(isBigEndian);
    file.AddPage(page);
    EXPECT_EQ(ReadAll<float>(*this->Open(file.GetBytes())),
              (std::vector<float>{ 1.0f, -2.0f, 65504.0f, 5.9604644775390625e-8f, 0.333251953125f, -INFINITY }));
  }
}

TEST_F(TiffReaderTest, ReadsImageJStacksOfOnePage)
{
  const auto        voxels = MakeVoxels<std::uint16_t>(4 * 15);
  const std::string text = "ImageJ=1.53t\nimages=4\nslices=4\nunit=\\u00B5m\nspacing=3.5\nloop=false\n";
  for (const bool isBigEndian : { false, true })
  {
    TiffTestFile file(isBigEndian);
    TiffTestPage page;
    page.Width = 5;
    page.Height = 3;
    page.Bits = 16;
    page.Description = text;
    page.PixelsPerCentimetre = 2; // in ImageJ's unit, as the description has one
    // The first page's data, then the others', then the directory: as ImageJ writes above 4 GiB, but in this order.
    page.Blocks = { ToBytes(voxels, isBigEndian) };
    file.AddPage(page);
    const auto reader = this->Open(file.GetBytes());
    EXPECT_EQ(reader->GetDescription().Grid.Size, (std::vector<std::uint64_t>{ 5, 3, 4 }));
    EXPECT_EQ(reader->GetDescription().Grid.Spacing, (std::vector<double>{ 0.0005, 0.0005, 0.0035 }));
    EXPECT_EQ(ReadAll<std::uint16_t>(*reader), voxels);
    EXPECT_EQ(ReadBox<std::uint16_t>(*reader, Box{ { 4, 1 }, { 2, 1 }, { 1, 2 } }),
              (std::vector<std::uint16_t>{ voxels[29], voxels[44] }));
  }
  EXPECT_EQ(m_Warnings.GetNumber(), 0u);

  TiffTestPage cut;
  cut.Width = 5;
  cut.Height = 3;
  cut.Description = "ImageJ=1.53t\nimages=40\nslices=40\n";
  TiffTestFile file;
  file.AddPage(cut, MakeVoxels<std::uint16_t>(15));
  EXPECT_TRUE(Contains(this->GetOpeningError(file.GetBytes()), "truncated"));
}

TEST_F(TiffReaderTest, LetsTheUserChooseAmongChannelsAndFrames)
{
  const auto        voxels = MakeVoxels<float>(2 * 2 * 3 * 15);
  const std::string text = "ImageJ=1.53t\nimages=12\nchannels=3\nslices=2\nframes=2\nhyperstack=true\n";
  const std::string bytes = MakeStack(voxels, text).GetBytes();
  EXPECT_TRUE(Contains(this->GetOpeningError(bytes), "--channel 0 to 2"));
  InputOptions channel;
  channel.Channel = 1;
  EXPECT_TRUE(Contains(this->GetOpeningError(bytes, channel), "--frame 0 to 1"));
  EXPECT_TRUE(Contains(this->GetOpeningError(bytes, Choose(3, 0)), "no channel 3"));
  // Planes are frame by frame, in each slice by slice, in each channel by channel.
  const auto         reader = this->Open(bytes, Choose(2, 1));
  std::vector<float> chosen(voxels.begin() + 8 * 15, voxels.begin() + 9 * 15);
  chosen.insert(chosen.end(), voxels.begin() + 11 * 15, voxels.begin() + 12 * 15);
  EXPECT_EQ(ReadAll<float>(*reader), chosen);
}

TEST_F(TiffReaderTest, TakesMoreChannelsThanImageJShowsForSlices)
{
  // As tifffile writes an array of three axes for ImageJ.
  const auto voxels = MakeVoxels<std::uint16_t>(9 * 15);
  const auto describe = [](const std::string & count) {
    return "ImageJ=1.11a\nimages=" + count + "\nchannels=" + count + "\nhyperstack=true\nmode=grayscale\n";
  };
  const std::string pages = MakeStack(voxels, describe("9")).GetBytes();
  TiffTestFile      onePage;
  TiffTestPage      page;
  page.Width = 5;
  page.Height = 3;
  page.Bits = 16;
  page.Description = describe("9");
  page.Blocks = { ToBytes(voxels, false) };
  onePage.AddPage(page);
  for (const std::string & bytes : { pages, onePage.GetBytes() })
  {
    const auto reader = this->Open(bytes);
    EXPECT_EQ(reader->GetDescription().Grid.Size, (std::vector<std::uint64_t>{ 5, 3, 9 }));
    EXPECT_EQ(ReadAll<std::uint16_t>(*reader), voxels);
    EXPECT_TRUE(m_Warnings.Mention("9 channels"));
    EXPECT_EQ(ReadAll<std::uint16_t>(*this->Open(bytes, Choose(8, 0))),
              std::vector<std::uint16_t>(voxels.end() - 15, voxels.end()));
  }
  const std::vector<std::uint16_t> seven(voxels.begin(), voxels.begin() + 7 * 15);
  EXPECT_TRUE(Contains(this->GetOpeningError(MakeStack(seven, describe("7")).GetBytes()), "--channel 0 to 6"));
}

TEST_F(TiffReaderTest, AppliesTheCalibrationOfSignedNumbers)
{
  const std::vector<std::uint16_t> stored = { 0, 1, 32767, 32768, 32769, 65535, 0, 0, 0, 0, 0, 0, 0, 0, 0 };
  const auto reader = this->Open(MakeStack(stored, "ImageJ=1.53t\ncf=0\nc0=-32768.0\nc1=1.0\n").GetBytes());
  EXPECT_EQ(reader->GetDescription().Component, ElementType::Int16);
  const auto voxels = ReadAll<std::int16_t>(*reader);
  EXPECT_EQ(std::vector<std::int16_t>(voxels.begin(), voxels.begin() + 6),
            (std::vector<std::int16_t>{ -32768, -32767, -1, 0, 1, 32767 }));
}

TEST_F(TiffReaderTest, FollowsOme)
{
  const auto        voxels = MakeVoxels<std::uint8_t>(2 * 3 * 15);
  const std::string start =
    "<?xml version=\"1.0\"?><OME><Image><Pixels DimensionOrder=\"XYZTC\" SizeX=\"5\" SizeY=\"3\" "
    "SizeZ=\"3\" SizeC=\"2\" SizeT=\"1\" PhysicalSizeX=\"0.5\" PhysicalSizeY=\"250\" "
    "PhysicalSizeYUnit=\"nm\" PhysicalSizeZ=\"2\" PhysicalSizeZUnit=\"mm\">";
  const std::string end = "</Pixels></Image></OME>";
  const auto        reader = this->Open(MakeStack(voxels, start + "<TiffData/>" + end).GetBytes(), Choose(1, 0));
  EXPECT_EQ(ReadAll<std::uint8_t>(*reader), std::vector<std::uint8_t>(voxels.begin() + 45, voxels.end()));
  EXPECT_EQ(reader->GetDescription().Grid.Spacing, (std::vector<double>{ 0.0005, 0.00025, 2.0 }));

  std::string several;
  for (const std::string name : { "a", "b" })
  {
    several += "<TiffData FirstC=\"" + std::string(name == "a" ? "0" : "1") + "\" PlaneCount=\"3\"><UUID FileName=\"" +
               name + ".ome.tif\">x</UUID></TiffData>";
  }
  EXPECT_TRUE(Contains(this->GetOpeningError(MakeStack(voxels, start + several + end).GetBytes(), Choose(1, 0)),
                       "several files"));
  const std::vector<std::uint8_t> fewer(voxels.begin(), voxels.begin() + 75);
  EXPECT_TRUE(
    Contains(this->GetOpeningError(MakeStack(fewer, start + "<TiffData/>" + end).GetBytes(), Choose(1, 0)), "5 pages"));
}

TEST_F(TiffReaderTest, RefusesPagesThatDifferAndSkipsThumbnails)
{
  TiffTestPage page;
  page.Width = 5;
  page.Height = 3;
  TiffTestPage thumbnail;
  thumbnail.Width = 2;
  thumbnail.Height = 1;
  thumbnail.SubfileType = 1;
  const auto   pixels = MakeVoxels<std::uint16_t>(30);
  const auto   first = std::vector<std::uint16_t>(pixels.begin(), pixels.begin() + 15);
  const auto   second = std::vector<std::uint16_t>(pixels.begin() + 15, pixels.end());
  TiffTestFile file;
  file.AddPage(page, first);
  file.AddPage(thumbnail, std::vector<std::uint16_t>{ 1, 2 });
  file.AddPage(page, second);
  EXPECT_EQ(ReadAll<std::uint16_t>(*this->Open(file.GetBytes())), pixels);

  file.AddPage(page, MakeVoxels<std::int16_t>(15));
  EXPECT_TRUE(Contains(this->GetOpeningError(file.GetBytes()), "its page 4 is 5 x 3 int16"));
}

TEST_F(TiffReaderTest, RefusesPagesThatAreTurnedInDifferentWays)
{
  const auto make = [](const std::vector<std::uint16_t> & orientations) {
    TiffTestFile file;
    TiffTestPage page;
    page.Width = 5;
    page.Height = 3;
    for (const std::uint16_t orientation : orientations)
    {
      page.Orientation = orientation;
      file.AddPage(page, std::vector<std::uint8_t>(15, 1));
    }
    return file.GetBytes();
  };
  EXPECT_TRUE(Contains(this->GetOpeningError(make({ 1, 1, 3 })), "its page 3"));
  EXPECT_TRUE(Contains(this->GetOpeningError(make({ 3, 1 })), "orientation 1"));
  EXPECT_TRUE(Contains(this->GetOpeningError(make({ 0, 2 })), "orientation 2"));
  EXPECT_EQ(m_Warnings.GetNumber(), 0u);
  EXPECT_EQ(this->GetOpeningError(make({ 0, 1, 0 })), ""); // 1 is what a page without it has
  EXPECT_EQ(m_Warnings.GetNumber(), 0u);
  EXPECT_EQ(this->GetOpeningError(make({ 3, 0, 3 })), ""); // said once for all
  EXPECT_TRUE(m_Warnings.Mention("orientation 3"));
}

TEST_F(TiffReaderTest, JpegOf12BitsIsNotCalledDamaged)
{
  TiffTestFile file;
  TiffTestPage page;
  page.Width = 8;
  page.Height = 8;
  page.Bits = 12;
  page.Compression = 7;
  page.Blocks = { std::string(200, 'x') };
  file.AddPage(page);
  EXPECT_TRUE(Contains(this->GetOpeningError(file.GetBytes()), "JPEG of 12 bits"));
}

TEST_F(TiffReaderTest, AResolutionWithoutAUnitSaysNoSpacing)
{
  TiffTestPage page;
  page.Width = 5;
  page.Height = 3;
  const auto getSpacing = [&](int pages) {
    TiffTestFile file;
    for (int i = 0; i < pages; ++i)
    {
      file.AddPage(page, std::vector<std::uint8_t>(15, 1));
    }
    return this->Open(file.GetBytes())->GetDescription().Grid.Spacing;
  };
  page.PixelsPerNothing = 1;
  EXPECT_EQ(getSpacing(1), std::vector<double>(2, 1.0));
  EXPECT_EQ(m_Warnings.GetNumber(), 0u);
  page.PixelsPerNothing = 72;
  EXPECT_EQ(getSpacing(1), std::vector<double>(2, 1.0));
  EXPECT_EQ(m_Warnings.GetNumber(), 1u);
  EXPECT_EQ(getSpacing(2), std::vector<double>(3, 1.0));
  EXPECT_TRUE(m_Warnings.Mention("without a unit"));
  page.Description = "ImageJ=1.53\nimages=1\nunit=micron\n"; // that of the resolution
  page.PixelsPerNothing = 2;
  EXPECT_EQ(getSpacing(1), std::vector<double>(2, 0.0005));
}

TEST_F(TiffReaderTest, TellsOfPagesOfOtherResolutions)
{
  TiffTestFile file;
  TiffTestPage page;
  page.Width = 5;
  page.Height = 3;
  for (const std::uint32_t resolution : { 20, 20, 40 })
  {
    page.PixelsPerCentimetre = resolution;
    file.AddPage(page, std::vector<std::uint8_t>(15, 1));
  }
  EXPECT_EQ(this->Open(file.GetBytes())->GetDescription().Grid.Spacing, std::vector<double>(3, 0.5));
  EXPECT_TRUE(m_Warnings.Mention("other resolutions"));
}

TEST_F(TiffReaderTest, TurnsEachInvertedPageRoundAndTellsOfIt)
{
  TiffTestFile file;
  TiffTestPage page;
  page.Width = 2;
  page.Height = 1;
  file.AddPage(page, std::vector<std::uint8_t>{ 1, 2 });
  page.Photometric = 0;
  file.AddPage(page, std::vector<std::uint8_t>{ 1, 2 });
  const auto reader = this->Open(file.GetBytes());
  EXPECT_EQ(ReadAll<std::uint8_t>(*reader), (std::vector<std::uint8_t>{ 1, 2, 254, 253 }));
  EXPECT_TRUE(m_Warnings.Mention("0 as white"));
}

TEST_F(TiffReaderTest, RefusesWhatItCannotGiveAsItIs)
{
  TiffTestPage page;
  page.Width = 2;
  page.Height = 1;
  page.Photometric = 5; // CMYK
  page.Samples = 4;
  page.Blocks = { "abcdefgh" };
  TiffTestFile inks;
  inks.AddPage(page);
  EXPECT_TRUE(Contains(this->GetOpeningError(inks.GetBytes()), "colours of a kind that is not supported"));

  page.Photometric = 3; // a colour table, of one blue among greys
  page.Samples = 1;
  page.Blocks = { "ab" };
  for (std::uint64_t i = 0; i < 3 * 256; ++i)
  {
    page.ColourTable.push_back(i % 256 * 257);
  }
  TiffTestFile grey;
  grey.AddPage(page);
  EXPECT_EQ(ReadAll<std::uint8_t>(*this->Open(grey.GetBytes())), (std::vector<std::uint8_t>{ 'a', 'b' }));
  page.ColourTable.back() = 0;
  TiffTestFile table;
  table.AddPage(page);
  EXPECT_TRUE(Contains(this->GetOpeningError(table.GetBytes()), "colour table"));

  page.ColourTable.clear();
  page.Photometric = 0;
  page.Format = 2;
  TiffTestFile white;
  white.AddPage(page);
  EXPECT_TRUE(Contains(this->GetOpeningError(white.GetBytes()), "0 is white"));
}

TEST_F(TiffReaderTest, RefusesEveryTruncatedFile)
{
  const std::string bytes = MakeStack(MakeVoxels<std::uint16_t>(30), "").GetBytes();
  EXPECT_EQ(this->GetOpeningError(bytes), "");
  for (std::size_t size = 0; size < bytes.size(); ++size)
  {
    EXPECT_TRUE(Contains(this->GetOpeningError(bytes.substr(0, size)), "cannot read ")) << size << " bytes";
  }
}
