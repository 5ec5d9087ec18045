// SPDX-License-Identifier: Apache-2.0
#include "TestFolder.h"
#include "TiffTestFile.h"
#include "VolumeTestAccess.h"
#include "VolumeTestImages.h"
#include "itk/JpegOrientation.h"
#include "slices/SliceFolder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

using itk::Subdivision::Box;

namespace
{
class SliceFolderTest : public ::testing::Test
{
protected:
  /** Writes a slice of 4 x 2 pixels, all of one value. */
  void
  WriteSlice(const std::string & name, std::uint16_t value, std::uint32_t pixelsPerCentimetre = 0) const
  {
    TiffTestFile file;
    TiffTestPage page;
    page.Width = 4;
    page.Height = 2;
    page.PixelsPerCentimetre = pixelsPerCentimetre;
    file.AddPage(page, std::vector<std::uint16_t>(8, value));
    m_Folder.WriteFile(name, file.GetBytes());
  }

  std::unique_ptr<VolumeReader>
  Open(const InputOptions & options = {})
  {
    return OpenSliceFolder(m_Folder / "", options, m_Warnings.GetSink());
  }

  std::string
  GetOpeningError()
  {
    return GetError([&] { this->Open(); });
  }

  /** The values of the slices in the order of the volume. */
  std::vector<std::uint16_t>
  GetOrder()
  {
    const auto reader = this->Open();
    const auto slices = reader->GetDescription().Grid.Size[2];
    return ReadBox<std::uint16_t>(*reader, Box{ { 3, 1 }, { 1, 1 }, { 0, slices } });
  }

  TestFolder   m_Folder;
  KeptWarnings m_Warnings;
};
} // namespace

TEST_F(SliceFolderTest, OrdersSlicesByNumberAndPassesOverOtherFiles)
{
  for (const int number : { 10, 2, 1, 9, 3, 4, 5, 6, 7, 8, 11 })
  {
    this->WriteSlice("My slice \xC3\xA9 " + std::to_string(number) + (number % 2 == 0 ? ".tif" : ".TIFF"),
                     static_cast<std::uint16_t>(number));
  }
  m_Folder.WriteFile("._My slice 1.tif", "of macOS");
  m_Folder.WriteFile("Thumbs.db", "x");
  m_Folder.WriteFile("scan.log", "x");
  std::filesystem::create_directory(m_Folder / "12.tif");
  EXPECT_TRUE(HoldsSlices(m_Folder / ""));
  EXPECT_EQ(this->GetOrder(), (std::vector<std::uint16_t>{ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 }));
  EXPECT_EQ(m_Warnings.GetNumber(), 0u);
}

TEST_F(SliceFolderTest, TakesNumbersAnywhereAndOfAnySize)
{
  this->WriteSlice("2024-01-02_10000000001_rec.tif", 2);
  this->WriteSlice("2024-01-02_10000000000_rec.tif", 1);
  this->WriteSlice("2024-01-02_9999999999_rec.tif", 0);
  EXPECT_EQ(this->GetOrder(), (std::vector<std::uint16_t>{ 0, 1, 2 }));
}

TEST_F(SliceFolderTest, RefusesSlicesThatAreTurnedInDifferentWays)
{
  const auto write = [&](const std::string & name, std::uint16_t orientation) {
    TiffTestFile file;
    TiffTestPage page;
    page.Width = 4;
    page.Height = 2;
    page.Orientation = orientation;
    file.AddPage(page, std::vector<std::uint16_t>(8, 1));
    m_Folder.WriteFile(name, file.GetBytes());
  };
  write("a1.tif", 1);
  write("a2.tif", 0);
  EXPECT_EQ(this->GetOpeningError(), "");
  EXPECT_EQ(m_Warnings.GetNumber(), 0u);
  write("a3.tif", 6);
  EXPECT_TRUE(Contains(this->GetOpeningError(), "a3.tif asks to be shown in another way (orientation 6)"));
  write("a1.tif", 6);
  write("a2.tif", 6);
  EXPECT_EQ(this->GetOpeningError(), "");
  EXPECT_TRUE(m_Warnings.Mention("orientation 6"));
}

// JPEG files ask by Exif data: a TIFF file's directory, in either byte order, in a segment of its own.
TEST_F(SliceFolderTest, JpegSlicesThatAreTurned)
{
  const auto write = [&](const std::string & name, std::uint16_t orientation, bool isBigEndian) {
    ImageDescription description = VolumeTest::MakeDescription({ 8, 8 }, itk::Subdivision::ElementType::UInt8);
    description.Grid.Directions = { { 1, 0 }, { 0, 1 } };
    VolumeTest::WriteVolume(m_Folder / name, description, VolumeTest::MakeVoxels(description));
    const auto number = [isBigEndian](std::uint32_t value, std::size_t bytes) {
      const std::string all = ToBytes(std::vector<std::uint32_t>{ value }, isBigEndian);
      return isBigEndian ? all.substr(4 - bytes) : all.substr(0, bytes);
    };
    std::string exif("Exif\0\0", 6);
    exif += (isBigEndian ? "MM" : "II") + number(42, 2) + number(8, 4) + number(2, 2);
    exif += number(0x128, 2) + number(3, 2) + number(1, 4) + number(2, 2) + number(0, 2);
    exif += number(0x112, 2) + number(3, 2) + number(1, 4) + number(orientation, 2) + number(0, 2) + number(0, 4);
    const std::string content = m_Folder.ReadFile(name);
    const std::string length = { '\0', static_cast<char>(exif.size() + 2) };
    m_Folder.WriteFile(name, content.substr(0, 2) + "\xFF\xE1" + length + exif + content.substr(2));
  };
  write("a1.jpg", 1, true);
  write("a2.jpg", 1, false);
  EXPECT_EQ(this->GetOpeningError(), "");
  EXPECT_EQ(m_Warnings.GetNumber(), 0u);
  write("a2.jpg", 6, false);
  EXPECT_TRUE(Contains(this->GetOpeningError(), "a2.jpg asks to be shown in another way (orientation 6)"));
  write("a1.jpg", 6, true);
  EXPECT_EQ(this->GetOpeningError(), "");
  EXPECT_TRUE(m_Warnings.Mention("orientation 6"));
  KeptWarnings warnings;
  OpenVolume(m_Folder / "a1.jpg", {}, warnings.GetSink());
  EXPECT_TRUE(warnings.Mention("a1.jpg asks to be shown turned or flipped (orientation 6)"));
  for (std::uintmax_t size = 2; size < 60; ++size)
  {
    m_Folder.WriteFile("cut.jpg", m_Folder.ReadFile("a1.jpg").substr(0, size));
    const std::uint16_t orientation = ReadJpegOrientation(m_Folder / "cut.jpg");
    EXPECT_TRUE(orientation == 1 || orientation == 6) << size;
  }
}

TEST_F(SliceFolderTest, TellsOfGaps)
{
  for (const std::uint16_t number : { 1, 2, 5, 6, 20 })
  {
    this->WriteSlice("s" + std::to_string(number) + ".tif", number);
  }
  EXPECT_EQ(this->GetOrder(), (std::vector<std::uint16_t>{ 1, 2, 5, 6, 20 }));
  EXPECT_EQ(m_Warnings.GetNumber(), 1u);
  EXPECT_TRUE(m_Warnings.Mention("3, 4, 7, 8, 9 and 10 others"));
}

TEST_F(SliceFolderTest, RefusesSeveralSeries)
{
  this->WriteSlice("a_1.tif", 1);
  this->WriteSlice("b_2.tif", 2);
  EXPECT_TRUE(Contains(this->GetOpeningError(), "a_1.tif and b_2.tif"));
}

TEST_F(SliceFolderTest, LeavesAPreviewWithoutANumberAside)
{
  for (const std::uint16_t number : { 0, 1, 2 })
  {
    this->WriteSlice("mouse 12_rec000" + std::to_string(number) + ".tif", number);
  }
  m_Folder.WriteFile("mouse 12_rec.log", "x");
  for (const std::string preview : { "mouse 12_rec_spr.tif", "mouse 12_rec_spr.bmp", "a.png", "z.tif" })
  {
    m_Folder.WriteFile(preview, "not even a picture");
    const auto before = m_Warnings.GetNumber();
    EXPECT_EQ(this->GetOrder(), (std::vector<std::uint16_t>{ 0, 1, 2 })) << preview;
    EXPECT_EQ(m_Warnings.GetNumber(), before + 1);
    EXPECT_TRUE(m_Warnings.Mention("the picture " + preview));
    std::filesystem::remove(m_Folder / preview);
  }
  // It may be the first slice, or of another series, or there are several.
  for (const std::string name : { "mouse 12_rec.tif", "mouse 12_rec.bmp", "rat 7_rec0003.tif" })
  {
    m_Folder.WriteFile(name, "x");
    EXPECT_NE(this->GetOpeningError(), "") << name;
    std::filesystem::remove(m_Folder / name);
  }
  m_Folder.WriteFile("mouse 12_rec_spr.bmp", "x");
  m_Folder.WriteFile("mouse 12_rec_sag.bmp", "x");
  EXPECT_TRUE(Contains(this->GetOpeningError(), "several formats"));
}

TEST_F(SliceFolderTest, ANameWithoutANumberMayBeTheFirstSlice)
{
  for (const std::string start : { "s_", "s-", "s (", "s.", "s" })
  {
    std::vector<std::string> names = { "s.tif" };
    for (const std::string number : { "1", "2", "3" })
    {
      names.push_back(start + number + (start.back() == '(' ? ")" : "") + ".tif");
    }
    for (const std::string & name : names)
    {
      this->WriteSlice(name, 1);
    }
    EXPECT_NE(this->GetOpeningError(), "") << start;
    for (const std::string & name : names)
    {
      std::filesystem::remove(m_Folder / name);
    }
  }
}

TEST_F(SliceFolderTest, RefusesNamesWithTwoNumbers)
{
  this->WriteSlice("z1_c0.tif", 1);
  this->WriteSlice("z1_c1.tif", 2);
  this->WriteSlice("z2_c0.tif", 3);
  EXPECT_TRUE(Contains(this->GetOpeningError(), "more than one number"));
}

TEST_F(SliceFolderTest, RefusesANumberThatIsThereTwice)
{
  this->WriteSlice("s_1.tif", 1);
  this->WriteSlice("s_01.tif", 2);
  EXPECT_TRUE(Contains(this->GetOpeningError(), "s_01.tif and s_1.tif"));
}

TEST_F(SliceFolderTest, RefusesNegativeNumbers)
{
  this->WriteSlice("s_-1.tif", 1);
  this->WriteSlice("s_-2.tif", 2);
  EXPECT_TRUE(Contains(this->GetOpeningError(), "negative"));
}

TEST_F(SliceFolderTest, RefusesSeveralFormats)
{
  this->WriteSlice("s_1.tif", 1);
  m_Folder.WriteFile("s_2.png", "x");
  EXPECT_TRUE(Contains(this->GetOpeningError(), "s_1.tif and s_2.png"));
}

TEST_F(SliceFolderTest, NamesTheOddSlice)
{
  this->WriteSlice("s_1.tif", 1);
  this->WriteSlice("s_2.tif", 2);
  TiffTestPage page;
  page.Width = 4;
  page.Height = 3;
  TiffTestFile larger;
  larger.AddPage(page, std::vector<std::uint16_t>(12));
  m_Folder.WriteFile("s_3.tif", larger.GetBytes());
  EXPECT_TRUE(Contains(this->GetOpeningError(), "s_3.tif is 4 x 3 uint16, but s_1.tif is 4 x 2 uint16"));

  page.Height = 2;
  TiffTestFile ofAnotherType;
  ofAnotherType.AddPage(page, std::vector<std::int16_t>(8));
  m_Folder.WriteFile("s_3.tif", ofAnotherType.GetBytes());
  EXPECT_TRUE(Contains(this->GetOpeningError(), "s_3.tif is 4 x 2 int16"));

  TiffTestFile pages;
  pages.AddPage(page, std::vector<std::uint16_t>(8));
  pages.AddPage(page, std::vector<std::uint16_t>(8));
  m_Folder.WriteFile("s_3.tif", pages.GetBytes());
  EXPECT_TRUE(Contains(this->GetOpeningError(), "s_3.tif: it has several pages"));

  m_Folder.WriteFile("s_3.tif", pages.GetBytes().substr(0, 60));
  EXPECT_TRUE(Contains(this->GetOpeningError(), "s_3.tif"));

  std::filesystem::remove(m_Folder / "s_3.tif");
  ASSERT_EQ(mkfifo((m_Folder / "s_3.tif").c_str(), 0600), 0);
  EXPECT_TRUE(Contains(this->GetOpeningError(), "s_3.tif: it is not a regular file"));
}

TEST_F(SliceFolderTest, RefusesAFolderWithoutSlices)
{
  m_Folder.WriteFile("notes.txt", "x");
  EXPECT_FALSE(HoldsSlices(m_Folder / ""));
  EXPECT_TRUE(Contains(this->GetOpeningError(), "it holds no TIFF, PNG, BMP or JPEG slices"));
}

TEST_F(SliceFolderTest, SaysWhatItAssumesOfTheSpacing)
{
  this->WriteSlice("s_1.tif", 1, 500);
  this->WriteSlice("s_2.tif", 2, 500);
  EXPECT_EQ(this->Open()->GetDescription().Grid.Spacing, (std::vector<double>{ 0.02, 0.02, 0.02 }));
  EXPECT_EQ(m_Warnings.GetNumber(), 1u);
  EXPECT_TRUE(m_Warnings.Mention("--spacing"));

  InputOptions options;
  options.Spacing = std::vector<double>{ 0.02, 0.02, 0.05 };
  options.Origin = std::vector<double>{ 1.0, 2.0, 3.0 };
  const auto reader = this->Open(options);
  EXPECT_EQ(reader->GetDescription().Grid.Spacing, *options.Spacing);
  EXPECT_EQ(reader->GetDescription().Grid.Origin, *options.Origin);
  EXPECT_TRUE(m_Warnings.Mention("is replaced by 0.02,0.02,0.05"));

  options.Spacing = std::vector<double>{ 1.0, 2.0 };
  EXPECT_TRUE(Contains(GetError([&] { this->Open(options); }), "3 axes"));
}

TEST_F(SliceFolderTest, NoticesASliceThatIsReplaced)
{
  this->WriteSlice("s_1.tif", 1);
  this->WriteSlice("s_2.tif", 2);
  const auto   reader = this->Open();
  TiffTestPage page;
  page.Width = 4;
  page.Height = 3;
  TiffTestFile file;
  file.AddPage(page, std::vector<std::uint16_t>(12));
  m_Folder.WriteFile("s_2.tif", file.GetBytes());
  EXPECT_TRUE(Contains(GetError([&] { ReadAll<std::uint16_t>(*reader); }), "changed"));
}
