// SPDX-License-Identifier: Apache-2.0
// Which DICOM files make a volume, and where it lies.

#include "DicomTest.h"
#include "formats/OpenVolume.h"

using itk::Subdivision::ElementType;

namespace
{
class DicomSeriesTest : public DicomTest
{};
} // namespace

TEST_F(DicomSeriesTest, SlicesAreSortedByPositionWhateverTheirNamesAndNumbers)
{
  const std::vector<unsigned int> numbers = { 7, 3, 9, 1 };
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    DicomTestData slice = MakeSlice(static_cast<int>(numbers[i]), 10 + 2.5 * static_cast<double>(i));
    if (i % 2 == 0)
    {
      slice.Remove(0x00200013);
    }
    slice.Write(m_Folder / ("sub" + std::to_string(i % 2)) / std::to_string(9 * i % 5));
  }
  std::ofstream(m_Folder / "README.txt") << "no image";
  std::ofstream(m_Folder / "empty");
  const auto        reader = Open();
  const ImageGrid & grid = reader->GetDescription().Grid;
  EXPECT_EQ(grid.Size, (std::vector<std::uint64_t>{ Columns, Rows, 4 }));
  EXPECT_EQ(grid.Spacing, (std::vector<double>{ 0.5, 0.75, 2.5 }));
  EXPECT_EQ(grid.Origin, (std::vector<double>{ 0, 0, 10 }));
  EXPECT_EQ(grid.Directions, (std::vector<std::vector<double>>{ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }));
  EXPECT_EQ(reader->GetDescription().Component, ElementType::Int16);
  EXPECT_TRUE(reader->ReadsParts());
  EXPECT_EQ(Read<std::int16_t>(*reader), Expect({ 7, 3, 9, 1 }));
  EXPECT_TRUE(m_Warnings.empty());
}

TEST_F(DicomSeriesTest, ABoxIsReadAlone)
{
  WriteSlices(5, 1);
  const auto  whole = Expect({ 0, 1, 2, 3, 4 });
  const auto  part = Read<std::int16_t>(*Open(), { { 1, 2 }, { 1, 2 }, { 2, 2 } });
  std::size_t i = 0;
  for (std::size_t z = 2; z < 4; ++z)
  {
    for (std::size_t y = 1; y < 3; ++y)
    {
      for (std::size_t x = 1; x < 3; ++x)
      {
        EXPECT_EQ(part[i++], whole[(z * Rows + y) * Columns + x]);
      }
    }
  }
}

TEST_F(DicomSeriesTest, ObliqueSlices)
{
  // Rows along (0.6, 0.8, 0), columns along -z: the normal is (-0.8, 0.6, 0). The files come from the far end.
  for (int i = 0; i < 4; ++i)
  {
    DicomTestData slice = MakeSlice(i, 0);
    slice.Set(0x00200037, "DS", "0.6\\0.8\\0\\0\\0\\-1");
    slice.SetPosition(5 + 0.8 * 3 * i, 6 - 0.6 * 3 * i, 7);
    slice.Write(m_Folder / std::to_string(i));
  }
  const auto        reader = Open();
  const ImageGrid & grid = reader->GetDescription().Grid;
  EXPECT_NEAR(grid.Spacing[2], 3, 1e-6);
  EXPECT_NEAR(grid.Origin[0], 5 + 0.8 * 9, 1e-6);
  EXPECT_NEAR(grid.Origin[1], 6 - 0.6 * 9, 1e-6);
  EXPECT_NEAR(grid.Directions[2][0], -0.8, 1e-12);
  EXPECT_NEAR(grid.Directions[2][1], 0.6, 1e-12);
  EXPECT_EQ(Read<std::int16_t>(*reader), Expect({ 3, 2, 1, 0 }));
}

TEST_F(DicomSeriesTest, SmallErrorsOfPositionsAreTolerated)
{
  for (int i = 0; i < 20; ++i)
  {
    DicomTestData slice = MakeSlice(i, i * 0.625 + (i % 3 - 1) * 0.004);
    slice.Write(m_Folder / std::to_string(i));
  }
  EXPECT_NEAR(Open()->GetDescription().Grid.Spacing[2], 0.625, 1e-3);
}

TEST_F(DicomSeriesTest, OneSlice)
{
  DicomTestData slice = MakeSlice(1, 5);
  slice.Set(0x00180050, "DS", "3.5");
  slice.Write(m_Folder / "a.dcm");
  const auto reader = Open({}, "a.dcm");
  EXPECT_EQ(reader->GetDescription().Grid.Size, (std::vector<std::uint64_t>{ Columns, Rows, 1 }));
  EXPECT_EQ(reader->GetDescription().Grid.Spacing[2], 3.5);
  EXPECT_EQ(Read<std::int16_t>(*reader), Expect({ 1 }));
}

TEST_F(DicomSeriesTest, MissingSlicesAreNamedByPosition)
{
  WriteSlices(9, 1.5);
  std::filesystem::remove(m_Folder / "3");
  std::filesystem::remove(m_Folder / "6");
  std::filesystem::remove(m_Folder / "7");
  EXPECT_TRUE(HasWords(GetRefusal(), { "3 slices are missing", "4.5, 9, 10.5 mm", "2, 4, 5, 8" }));
}

TEST_F(DicomSeriesTest, UnevenSpacingIsRefused)
{
  WriteSlices(6, 1);
  MakeSlice(5, 5.4).Write(m_Folder / "5");
  EXPECT_TRUE(HasWords(GetRefusal(), { "1 mm apart", "4, 5 are 1.4 mm" }));
}

TEST_F(DicomSeriesTest, ALocalizerIsNamed)
{
  WriteSlices(5, 1);
  DicomTestData turned = MakeSlice(7, 2);
  turned.Set(0x00200037, "DS", "1\\0\\0\\0\\0\\-1");
  turned.Write(m_Folder / "scout");
  EXPECT_TRUE(HasWords(GetRefusal(), { "1 of its 6 slices (scout)", "orientation" }));
  DicomTestData larger("1.2.3.4", 7, 9, 2, 6, MakeValues(3));
  larger.Write(m_Folder / "scout");
  EXPECT_TRUE(HasWords(GetRefusal(), { "1 of its 6 slices (scout)", "size" }));
}

TEST_F(DicomSeriesTest, PhasesAreChosenByNumber)
{
  for (int i = 0; i < 4; ++i)
  {
    for (int phase = 0; phase < 3; ++phase)
    {
      // Instance numbers run against the phases, which the temporal position tells.
      DicomTestData slice = MakeSlice(10 * phase + i, i);
      slice.Set(0x00200013, "IS", std::to_string(100 - 10 * phase + i));
      slice.Set(0x00200100, "IS", std::to_string(phase + 1));
      slice.Write(m_Folder / (std::to_string(i) + "-" + std::to_string(phase)));
    }
  }
  EXPECT_TRUE(
    HasWords(GetRefusal(), { "3 images stand at each of its 4 positions", "0-0, 0-1, 0-2", "--frame, 0 to 2" }));
  InputOptions options;
  options.Frame = 1;
  EXPECT_EQ(Read<std::int16_t>(*Open(options)), Expect({ 10, 11, 12, 13 }));
  options.Frame = 3;
  EXPECT_TRUE(HasWords(GetRefusal(options), { "no frame 3" }));
  std::filesystem::remove(m_Folder / "2-1");
  options.Frame = 0;
  EXPECT_TRUE(HasWords(GetRefusal(options), { "3 images", "but 2 (2-0, 2-2)" }));
}

TEST_F(DicomSeriesTest, ATiltedGantryIsRefused)
{
  WriteSlices(5, 2);
  for (int i = 0; i < 5; ++i)
  {
    DicomTestData slice = MakeSlice(i, 2 * i);
    slice.Set(0x00200037, "DS", "1\\0\\0\\0\\0.9659258\\0.2588190");
    slice.Write(m_Folder / std::to_string(i));
  }
  EXPECT_TRUE(HasWords(GetRefusal(), { "tilted by 15 degrees" }));
}

TEST_F(DicomSeriesTest, ASliceShiftedSidewaysIsNamed)
{
  WriteSlices(5, 2);
  DicomTestData slice = MakeSlice(3, 6);
  slice.SetPosition(0.4, 0, 6);
  slice.Write(m_Folder / "3");
  EXPECT_TRUE(HasWords(GetRefusal(), { "3 is shifted sideways by 0.4 mm" }));
}

TEST_F(DicomSeriesTest, CopiesAreLeftOut)
{
  WriteSlices(4, 1);
  MakeSlice(2, 2).Write(m_Folder / "backup" / "2");
  EXPECT_EQ(Read<std::int16_t>(*Open()), Expect({ 0, 1, 2, 3 }));
  ASSERT_EQ(m_Warnings.size(), 1U);
  EXPECT_TRUE(HasWords(m_Warnings[0], { "backup/2 is left out" }));
}

TEST_F(DicomSeriesTest, SeriesAreListedAndChosen)
{
  WriteSlices(3, 1);
  for (int i = 0; i < 2; ++i)
  {
    DicomTestData slice = MakeSlice(20 + i, i, "1.2.3.5");
    slice.Set(0x00200011, "IS", "-1");
    slice.Write(m_Folder / "second" / std::to_string(i));
  }
  for (const char * const kind : { "88.11", "66.1", "11.1", "481.5", "104.1" })
  {
    DicomTestData::MakeReport(std::string("1.2.840.10008.5.1.4.1.1.") + kind).Write(m_Folder / kind);
  }
  const auto all = ListDicomSeries(m_Folder.string());
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].Uid, "1.2.3.5");
  EXPECT_EQ(all[1].Uid, "1.2.3.4");
  EXPECT_EQ(all[1].Description, "Thorax 1.2.3.4");
  EXPECT_EQ(all[1].Modality, "CT");
  EXPECT_EQ(all[1].NumberOfSlices, 3U);
  EXPECT_EQ(all[1].Columns, Columns);
  EXPECT_EQ(all[1].Rows, Rows);

  EXPECT_TRUE(HasWords(GetRefusal(), { "--series", "1: \"Thorax 1.2.3.5\" CT 2 x 4 x 3, 1.2.3.5; 2: " }));
  InputOptions options;
  options.Series = "2";
  EXPECT_EQ(Read<std::int16_t>(*Open(options)), Expect({ 0, 1, 2 }));
  options.Series = "1.2.3.5";
  EXPECT_EQ(Read<std::int16_t>(*Open(options)), Expect({ 20, 21 }));
  for (const char * const wanted : { "0", "3", "1.2.3", "99999999999999999999" })
  {
    options.Series = wanted;
    EXPECT_TRUE(HasWords(GetRefusal(options), { std::string("no DICOM series ") + wanted, "1.2.3.5", "1.2.3.4" }));
  }
}

TEST_F(DicomSeriesTest, ChannelsAreNotChosen)
{
  const auto getError = [this](const InputOptions & options) -> std::string {
    try
    {
      OpenVolume(m_Folder.string(), options, [](const std::string &) {});
    }
    catch (const std::runtime_error & error)
    {
      return error.what();
    }
    return "";
  };
  for (const bool hasColours : { false, true })
  {
    for (int i = 0; i < 3; ++i)
    {
      DicomTestData slice = MakeSlice(i, i);
      if (hasColours)
      {
        slice.Set(0x00280004, "CS", "RGB");
        slice.SetShort(0x00280002, 3);
        slice.SetShort(0x00280006, 0);
        slice.SetBits(8, 8, false);
        slice.SetPixels(std::vector<std::uint8_t>(3 * Columns * Rows));
      }
      slice.Write(m_Folder / std::to_string(i));
    }
    InputOptions options;
    options.Series = "1";
    options.Frame = 0;
    EXPECT_EQ(getError(options), "");
    options.Channel = 0;
    EXPECT_TRUE(HasWords(getError(options), { m_Folder.string(), "--channel chooses among the channels of a TIFF" }));
  }
}

TEST_F(DicomSeriesTest, ADicomdirStandsForItsFolder)
{
  WriteSlices(3, 1);
  DicomTestData::MakeReport("1.2.840.10008.1.3.10").Write(m_Folder / "DICOMDIR");
  EXPECT_EQ(Read<std::int16_t>(*Open({}, "DICOMDIR")), Expect({ 0, 1, 2 }));
  EXPECT_EQ(Read<std::int16_t>(*Open()), Expect({ 0, 1, 2 }));
}

TEST_F(DicomSeriesTest, AnImageFileThatEndsBeforeItsSizeIsNamed)
{
  WriteSlices(3, 1);
  DicomTestData slice = DicomTestData::MakeReport("1.2.840.10008.5.1.4.1.1.2");
  slice.Write(m_Folder / "1");
  EXPECT_TRUE(HasWords(GetRefusal(), { "/1: the DICOM file is damaged" }));
}

TEST_F(DicomSeriesTest, AFolderWithoutDicom)
{
  EXPECT_TRUE(HasWords(GetRefusal(), { "no DICOM series" }));
  std::ofstream(m_Folder / "a.txt") << "text";
  EXPECT_TRUE(HasWords(GetRefusal(), { "no DICOM series" }));
  EXPECT_TRUE(HasWords(GetRefusal({}, "none"), { "none: No such file" }));
  EXPECT_THROW(ListDicomSeries(m_Folder.string()), std::runtime_error);
}

TEST_F(DicomSeriesTest, ImagesWithoutPositionAreStackedOnDemandOnly)
{
  for (int i = 0; i < 3; ++i)
  {
    DicomTestData slice = MakeSlice(3 - i, 0);
    slice.Remove(0x00200032);
    slice.Remove(0x00200037);
    slice.Write(m_Folder / std::to_string(i));
  }
  EXPECT_TRUE(HasWords(GetRefusal(), { "no position", "--frame", "--spacing" }));
  InputOptions options;
  options.Spacing = { 1, 1, 1 };
  EXPECT_EQ(Read<std::int16_t>(*Open(options)), Expect({ 1, 2, 3 }));
  EXPECT_EQ(m_Warnings.size(), 1U);
  options.Frame = 2;
  EXPECT_EQ(Read<std::int16_t>(*Open(options)), Expect({ 3 }));
}

TEST_F(DicomSeriesTest, GapsInTheNumbersOfImagesWithoutPositionAreWarnedOf)
{
  const auto write = [this](const std::vector<std::string> & numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      DicomTestData slice = MakeSlice(static_cast<int>(i), 0);
      slice.Remove(0x00200032);
      slice.Set(0x00200013, "IS", numbers[i]);
      slice.Write(m_Folder / std::to_string(i));
    }
  };
  InputOptions options;
  options.Spacing = { 1, 1, 1 };
  write({ "-1", "1", "4", "2" });
  EXPECT_EQ(Read<std::int16_t>(*Open(options)), Expect({ 0, 1, 3, 2 }));
  ASSERT_EQ(m_Warnings.size(), 2U);
  EXPECT_TRUE(HasWords(m_Warnings[1], { "the DICOM series lacks the slices with the numbers 0, 3: " }));
  write({ "1", "3", "7", "5" });
  Open(options);
  ASSERT_EQ(m_Warnings.size(), 2U);
  EXPECT_TRUE(HasWords(m_Warnings[1], { "the slices of the DICOM series are numbered in steps of 2" }));
  for (const char * const other : { "3", "", "2.5" })
  {
    write({ "1", "3", other, "2" });
    EXPECT_TRUE(HasWords(GetRefusal(options), { "no position", "needs different instance numbers" }));
  }
}

TEST_F(DicomSeriesTest, AFolderThatMayNotBeEnteredIsNamed)
{
  WriteSlices(3, 1);
  const auto hidden = m_Folder / "hidden";
  MakeSlice(3, 3).Write(hidden / "3");
  std::filesystem::permissions(hidden, std::filesystem::perms::none);
  // For the superuser, no folder is closed.
  if (std::error_code error; (std::filesystem::directory_iterator(hidden, error), error))
  {
    EXPECT_TRUE(HasWords(GetRefusal(), { "cannot read " + hidden.string(), "Permission denied" }));
    EXPECT_THROW(ListDicomSeries(m_Folder.string()), std::runtime_error);
    std::filesystem::rename(hidden, m_Folder / "lost+found");
    EXPECT_EQ(Read<std::int16_t>(*Open()), Expect({ 0, 1, 2 }));
    std::filesystem::rename(m_Folder / "lost+found", hidden);
  }
  std::filesystem::permissions(hidden, std::filesystem::perms::owner_all);
  EXPECT_EQ(Read<std::int16_t>(*Open()), Expect({ 0, 1, 2, 3 }));
}

TEST_F(DicomSeriesTest, OutputIsRefused)
{
  try
  {
    RefuseDicomOutput("out.dcm");
    FAIL();
  }
  catch (const std::runtime_error & error)
  {
    EXPECT_TRUE(HasWords(error.what(), { "out.dcm", ".nrrd" }));
  }
}
