// SPDX-License-Identifier: Apache-2.0
// DICOM files of one instance UID: copies, and images that only say that they are.

#include "DicomTest.h"

#include <functional>

namespace
{
constexpr std::uint32_t InstanceUid = 0x00080018;

class DicomCopiesTest : public DicomTest
{
protected:
  /** Four slices, and in a folder of its own one that is like slice 2 but for a change. */
  void
  WriteTwin(const std::function<void(DicomTestData &)> & change)
  {
    WriteSlices(4, 1);
    DicomTestData twin = MakeSlice(2, 2);
    change(twin);
    twin.Write(m_Folder / "twin" / "2");
  }

  void
  ExpectLeftOut()
  {
    EXPECT_EQ(Read<std::int16_t>(*Open()), Expect({ 0, 1, 2, 3 }));
    ASSERT_EQ(m_Warnings.size(), 1U);
    EXPECT_TRUE(HasWords(m_Warnings[0], { "twin/2 is left out: it holds the same image as ", "/2" }));
  }

  void
  ExpectRefused()
  {
    EXPECT_TRUE(HasWords(GetRefusal(), { "twin/2: it has the SOP instance UID 1.2.3.4.2 of ", "not the same image" }));
  }
};
} // namespace

TEST_F(DicomCopiesTest, OfOtherBytesAreLeftOut)
{
  WriteTwin([](DicomTestData & twin) {
    twin.Set(0x00100010, "PN", "Nobody");
    twin.Set(0x00200013, "IS", "99");
  });
  ExpectLeftOut();
}

TEST_F(DicomCopiesTest, InAnotherEncodingAreLeftOut)
{
  WriteTwin([](DicomTestData &) {});
  Encode("twin/2", gdcm::TransferSyntax::RLELossless);
  ExpectLeftOut();
}

TEST_F(DicomCopiesTest, ImagesThatDifferAreNone)
{
  const std::vector<std::function<void(DicomTestData &)>> changes = {
    [](DicomTestData & twin) { twin.SetPosition(0, 0, 4); },
    [](DicomTestData & twin) { twin.SetPosition(0, 0.5, 2); },
    [](DicomTestData & twin) { twin.Set(0x00200037, "DS", "0\\1\\0\\1\\0\\0"); },
    [](DicomTestData & twin) { twin.Set(0x00280030, "DS", "0.75\\0.75"); },
    [](DicomTestData & twin) { twin.SetRescale("2", "0"); },
    [](DicomTestData & twin) { twin.SetRescale("1", "1"); },
    [](DicomTestData & twin) { twin.SetBits(16, 12, true); },
    [](DicomTestData & twin) { twin.SetShort(0x00280103, 0); },
    [](DicomTestData & twin) {
      auto                                                values = MakeValues(2);
      values.back() = static_cast<std::int16_t>(values.back() + 1);
      twin.SetPixels(values);
    },
  };
  for (const auto & change : changes)
  {
    WriteTwin(change);
    ExpectRefused();
  }
}

TEST_F(DicomCopiesTest, SlicesThatAllBearOneUidAreNoCopies)
{
  for (int i = 0; i < 5; ++i)
  {
    DicomTestData slice = MakeSlice(i, 0.7 * i);
    slice.Set(InstanceUid, "UI", "1.2.3.4.0");
    slice.Write(m_Folder / std::to_string(i));
  }
  EXPECT_TRUE(
    HasWords(GetRefusal(), { "/1: it has the SOP instance UID 1.2.3.4.0 of ", "/0, but not the same image" }));
}

TEST_F(DicomCopiesTest, ATwinThatIsTruncatedIsToldSo)
{
  WriteTwin([](DicomTestData &) {});
  std::filesystem::resize_file(m_Folder / "twin" / "2", std::filesystem::file_size(m_Folder / "twin" / "2") - 2);
  EXPECT_TRUE(HasWords(GetRefusal(), { "twin: 2 is truncated" }));
}

TEST_F(DicomCopiesTest, SlicesWithoutUidAreNotCompared)
{
  for (int i = 0; i < 3; ++i)
  {
    DicomTestData slice = MakeSlice(i, i);
    slice.Remove(InstanceUid);
    slice.Write(m_Folder / std::to_string(i));
  }
  EXPECT_EQ(Read<std::int16_t>(*Open()), Expect({ 0, 1, 2 }));
  EXPECT_TRUE(m_Warnings.empty());
}
