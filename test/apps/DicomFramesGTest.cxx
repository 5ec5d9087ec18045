// SPDX-License-Identifier: Apache-2.0
// What DICOM files of several frames tell of each: which of several attributes holds, and frames that differ.

#include "DicomTest.h"

namespace
{
constexpr std::uint32_t Orientation = 0x00200037;
constexpr std::uint32_t PixelSpacing = 0x00280030;
constexpr std::uint32_t ImagerPixelSpacing = 0x00181164;
constexpr std::uint32_t NominalScannedPixelSpacing = 0x00182010;
constexpr std::uint32_t SliceThickness = 0x00180050;
constexpr std::uint32_t SpacingBetweenSlices = 0x00180088;

class DicomFramesTest : public DicomTest
{
protected:
  /** Functional groups of one item with one attribute. */
  static DicomTestData
  MakeGroups(std::uint32_t sequence, std::uint32_t tag, const std::string & value)
  {
    DicomTestData item;
    item.Set(tag, "DS", value);
    DicomTestData groups;
    groups.SetItems(sequence, { item });
    return groups;
  }

  static DicomTestData
  MakeMeasures(const std::string & spacing, std::uint32_t tag = PixelSpacing)
  {
    return MakeGroups(0x00289110, tag, spacing);
  }

  static DicomTestData
  MakeOrientation(const std::string & cosines)
  {
    return MakeGroups(0x00209116, Orientation, cosines);
  }

  static DicomTestData
  MakeRescale(const std::string & slope)
  {
    return MakeGroups(0x00289145, 0x00281053, slope);
  }

  static void
  Place(DicomTestData & groups, double z)
  {
    DicomTestData position;
    position.SetPosition(0, 0, z);
    groups.SetItems(0x00209113, { position });
  }

  /** A file of as many frames as there are groups of them; it tells no spacing itself. */
  static DicomTestData
  MakeFile(const std::vector<DicomTestData> & frames, const DicomTestData & shared = {})
  {
    DicomTestData file = MakeSlice(1, 0);
    file.Remove(0x00200032);
    file.Remove(PixelSpacing);
    file.Set(0x00280008, "IS", std::to_string(frames.size()));
    std::vector<unsigned int> numbers(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
      numbers[i] = static_cast<unsigned int>(4 + i);
    }
    file.SetPixels(Expect(numbers));
    file.SetItems(0x52009229, { shared });
    file.SetItems(0x52009230, frames);
    return file;
  }

  /** Three frames at heights 0, 2 and 4, of which each tells something of its own. */
  static DicomTestData
  MakeStack(std::vector<DicomTestData> frames, const DicomTestData & shared = {})
  {
    for (std::size_t i = 0; i < frames.size(); ++i)
    {
      Place(frames[i], 2.0 * static_cast<double>(i));
    }
    return MakeFile(frames, shared);
  }

  std::vector<double>
  GetSpacing(const DicomTestData & file)
  {
    file.Write(m_Folder / "e.dcm");
    return Open()->GetDescription().Grid.Spacing;
  }

  std::string
  GetRefusalOf(const DicomTestData & file)
  {
    file.Write(m_Folder / "e.dcm");
    return GetRefusal();
  }

  const std::vector<DicomTestData> m_Nothing = std::vector<DicomTestData>(3);
  const DicomTestData              m_Measures = MakeMeasures("0.75\\0.5");
  const std::vector<double>        m_Spacing = { 0.5, 0.75, 2 };
};
} // namespace

TEST_F(DicomFramesTest, PixelSpacingHoldsBeforeNominalOnesWhereverItStands)
{
  for (const std::uint32_t nominal : { ImagerPixelSpacing, NominalScannedPixelSpacing })
  {
    DicomTestData shared = MakeStack(m_Nothing, m_Measures);
    shared.Set(nominal, "DS", "0.1\\0.2");
    EXPECT_EQ(GetSpacing(shared), m_Spacing);
    DicomTestData ofFrames = MakeStack({ m_Measures, m_Measures, m_Measures });
    ofFrames.Set(nominal, "DS", "0.1\\0.2");
    EXPECT_EQ(GetSpacing(ofFrames), m_Spacing);
    DicomTestData file = MakeStack(m_Nothing, MakeMeasures("0.1\\0.2", nominal));
    file.Set(PixelSpacing, "DS", "0.75\\0.5");
    EXPECT_EQ(GetSpacing(file), m_Spacing);
    DicomTestData alone = MakeStack(m_Nothing);
    alone.Set(nominal, "DS", "0.1\\0.2");
    EXPECT_EQ(GetSpacing(alone), (std::vector<double>{ 0.2, 0.1, 2 }));
  }
}

TEST_F(DicomFramesTest, WhatAFrameTellsHoldsBeforeWhatAllShareAndTheFile)
{
  DicomTestData file = MakeStack(m_Nothing, m_Measures);
  file.Set(PixelSpacing, "DS", "9\\8");
  EXPECT_EQ(GetSpacing(file), m_Spacing);
  EXPECT_EQ(GetSpacing(MakeStack({ m_Measures, m_Measures, m_Measures }, MakeMeasures("9\\8"))), m_Spacing);

  const DicomTestData twice = MakeRescale("2");
  DicomTestData       rescaled = MakeStack({ twice, twice, MakeRescale("3") }, MakeRescale("5"));
  rescaled.SetRescale("7", "0");
  rescaled.Write(m_Folder / "e.dcm");
  const auto values = Read<std::int32_t>(*Open());
  const auto stored = Expect({ 4, 5, 6 });
  ASSERT_EQ(values.size(), stored.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    EXPECT_EQ(values[i], stored[i] * (i < 2 * Columns * Rows ? 2 : 3));
  }

  const DicomTestData upright = MakeOrientation("1\\0\\0\\0\\1\\0");
  DicomTestData       turned = MakeStack({ upright, upright, upright }, MakeOrientation("0\\1\\0\\0\\0\\1"));
  turned.Set(Orientation, "DS", "0\\0\\1\\1\\0\\0");
  turned.Write(m_Folder / "e.dcm");
  EXPECT_EQ(Open()->GetDescription().Grid.Directions[0], (std::vector<double>{ 1, 0, 0 }));
}

TEST_F(DicomFramesTest, FramesThatDifferAreNamed)
{
  const DicomTestData other = MakeMeasures("0.9\\0.9");
  EXPECT_TRUE(HasWords(GetRefusalOf(MakeStack({ m_Measures, other, m_Measures })),
                       { "1 of its 3 slices (frame 2 of e.dcm)", "spacing of the pixels" }));
  EXPECT_TRUE(HasWords(GetRefusalOf(MakeStack({ {}, {}, other }, m_Measures)),
                       { "1 of its 3 slices (frame 3 of e.dcm)", "spacing of the pixels" }));
  EXPECT_TRUE(HasWords(GetRefusalOf(MakeStack({ m_Measures, m_Measures, {} })),
                       { "1 of its 3 slices (frame 3 of e.dcm)", "spacing of the pixels" }));
  EXPECT_TRUE(HasWords(GetRefusalOf(MakeStack({ {}, MakeOrientation("1\\0\\0\\0\\0\\1"), {} }, m_Measures)),
                       { "1 of its 3 slices (frame 2 of e.dcm)", "orientation" }));
  EXPECT_TRUE(HasWords(GetRefusalOf(MakeStack({ MakeRescale("2"), {}, MakeRescale("2") }, m_Measures)),
                       { "1 of its 3 slices (frame 2 of e.dcm)", "slope" }));
  EXPECT_EQ(GetRefusalOf(MakeStack({ MakeRescale("1"), {}, MakeRescale("1") }, m_Measures)), "");
}

TEST_F(DicomFramesTest, ASliceWithoutARescaleAmongOthersIsNamed)
{
  for (int i = 0; i < 3; ++i)
  {
    DicomTestData slice = MakeSlice(i, i);
    if (i != 1)
    {
      slice.SetRescale("1", "-1024");
    }
    slice.Write(m_Folder / std::to_string(i));
  }
  EXPECT_TRUE(HasWords(GetRefusal(), { "1 of its 3 slices (1)", "intercept" }));
}

TEST_F(DicomFramesTest, ASliceThatLacksEitherTheSlopeOrTheInterceptOfOthersIsNamed)
{
  constexpr std::uint32_t slope = 0x00281053;
  constexpr std::uint32_t intercept = 0x00281052;
  const auto              getRefusal = [this](const char * slopes, const char * intercepts, auto && change) {
    for (int i = 0; i < 3; ++i)
    {
      DicomTestData slice = MakeSlice(i, i);
      slice.SetRescale(slopes, intercepts);
      if (i == 1)
      {
        change(slice);
      }
      slice.Write(m_Folder / std::to_string(i));
    }
    return GetRefusal();
  };
  for (const bool isEmpty : { false, true })
  {
    const auto withoutSlope = [&](DicomTestData & slice) {
      isEmpty ? slice.Set(slope, "DS", "") : slice.Remove(slope);
    };
    const auto withoutIntercept = [&](DicomTestData & slice) {
      isEmpty ? slice.Set(intercept, "DS", "") : slice.Remove(intercept);
    };
    EXPECT_TRUE(HasWords(getRefusal("1", "-1024", withoutIntercept), { "1 of its 3 slices (1)", "tell an intercept" }));
    EXPECT_TRUE(HasWords(getRefusal("2", "0", withoutSlope), { "1 of its 3 slices (1)", "tell a slope" }));
    EXPECT_EQ(getRefusal("1", "-1024", withoutSlope), "");
    EXPECT_EQ(getRefusal("2", "0", withoutIntercept), "");
  }
  // One of those that tell the slope has 1 by chance, as in PET, where each slice has its own.
  const auto withoutSlope = [&](DicomTestData & slice) { slice.Remove(slope); };
  getRefusal("1", "0", withoutSlope);
  DicomTestData last = MakeSlice(2, 2);
  last.SetRescale("3", "0");
  last.Write(m_Folder / "2");
  EXPECT_TRUE(HasWords(GetRefusal(), { "1 of its 3 slices (1)", "tell a slope" }));
}

TEST_F(DicomFramesTest, AFrameThatLacksTheInterceptOfOthersIsNamed)
{
  DicomTestData both;
  both.SetRescale("1", "-1024");
  DicomTestData whole;
  whole.SetItems(0x00289145, { both });
  EXPECT_TRUE(HasWords(GetRefusalOf(MakeStack({ whole, whole, MakeRescale("1") }, m_Measures)),
                       { "1 of its 3 slices (frame 3 of e.dcm)", "intercept" }));
}

TEST_F(DicomFramesTest, FilesOfFramesThatDifferAreNamed)
{
  MakeStack(m_Nothing, m_Measures).Write(m_Folder / "a.dcm");
  DicomTestData second = MakeFile({ {} }, MakeMeasures("0.9\\0.5"));
  second.Set(0x00080018, "UI", "1.2.3.4.2");
  second.Write(m_Folder / "b.dcm");
  EXPECT_TRUE(HasWords(GetRefusal(), { "1 of its 4 slices (b.dcm)", "spacing of the pixels" }));
}

TEST_F(DicomFramesTest, TheThicknessOfASliceIsTakenWhereNoDistanceIsTold)
{
  DicomTestData one = MakeFile({ m_Measures });
  one.Set(SliceThickness, "DS", "9");
  EXPECT_EQ(GetSpacing(one)[2], 9);
  one = MakeFile({ {} }, MakeMeasures("3", SpacingBetweenSlices));
  one.Set(SliceThickness, "DS", "9");
  EXPECT_EQ(GetSpacing(one)[2], 3);

  std::vector<DicomTestData> phases;
  for (const char * const spacing : { "1", "4", "5" })
  {
    phases.push_back(MakeMeasures(spacing, SpacingBetweenSlices));
    Place(phases.back(), 7);
  }
  MakeFile(phases).Write(m_Folder / "e.dcm");
  InputOptions options;
  options.Frame = 1;
  const auto reader = Open(options);
  EXPECT_EQ(reader->GetDescription().Grid.Spacing[2], 4);
  EXPECT_EQ(reader->GetDescription().Grid.Origin[2], 7);
  EXPECT_EQ(Read<std::int16_t>(*reader), Expect({ 5 }));
}

TEST_F(DicomFramesTest, ThePlaceOfTheFileIsNotThatOfEachFrame)
{
  DicomTestData file = MakeFile(m_Nothing, m_Measures);
  file.SetPosition(1, 2, 3);
  EXPECT_TRUE(HasWords(GetRefusalOf(file), { "3 images bear no position" }));

  DicomTestData shared = m_Measures;
  Place(shared, 5);
  file = MakeFile(m_Nothing, shared);
  EXPECT_TRUE(HasWords(GetRefusalOf(file), { "3 images stand at each of its 1 positions" }));
}
