// SPDX-License-Identifier: Apache-2.0
// The values of DICOM pixels: how they are stored, and what they mean.

#include "DicomTest.h"

#include <cmath>

using itk::Subdivision::ElementType;

namespace
{
class DicomPixelsTest : public DicomTest
{
protected:
  /** Three slices, changed by a function of the slice and its number. */
  template <typename TChange>
  void
  WriteThree(TChange && change, DicomTestData::Syntax syntax = DicomTestData::Syntax::ExplicitLittle)
  {
    for (int i = 0; i < 3; ++i)
    {
      DicomTestData slice = MakeSlice(i, i);
      change(slice, i);
      slice.Write(m_Folder / std::to_string(i), syntax);
    }
  }

  ElementType
  GetComponent()
  {
    return Open()->GetDescription().Component;
  }

  /** A file of three frames whose functional groups tell where they are: at heights 4, 2 and 0. */
  DicomTestData
  MakeEnhanced()
  {
    DicomTestData file = MakeSlice(1, 0);
    for (const std::uint32_t tag : { 0x00200032U, 0x00200037U, 0x00280030U })
    {
      file.Remove(tag);
    }
    file.Set(0x00280008, "IS", "3");
    file.SetPixels(Expect({ 4, 5, 6 }));
    DicomTestData orientation;
    orientation.Set(0x00200037, "DS", "1\\0\\0\\0\\1\\0");
    DicomTestData measures;
    measures.Set(0x00280030, "DS", "0.75\\0.5");
    DicomTestData shared;
    shared.SetItems(0x00209116, { orientation });
    shared.SetItems(0x00289110, { measures });
    file.SetItems(0x52009229, { shared });
    std::vector<DicomTestData> frames(3);
    for (int i = 0; i < 3; ++i)
    {
      DicomTestData position;
      position.SetPosition(0, 0, 4 - 2 * i);
      DicomTestData rescale;
      rescale.SetRescale(std::to_string(i + 1), "-10");
      frames[i].SetItems(0x00209113, { position });
      frames[i].SetItems(0x00289145, { rescale });
    }
    file.SetItems(0x52009230, frames);
    return file;
  }
};
} // namespace

TEST_F(DicomPixelsTest, EverySyntaxGivesTheSame)
{
  for (const auto syntax : { DicomTestData::Syntax::ImplicitLittle,
                             DicomTestData::Syntax::ExplicitLittle,
                             DicomTestData::Syntax::ExplicitBig })
  {
    WriteThree([](DicomTestData &, int) {}, syntax);
    EXPECT_EQ(Read<std::int16_t>(*Open()), Expect({ 0, 1, 2 })) << static_cast<int>(syntax);
  }
}

TEST_F(DicomPixelsTest, MorePixelsThanTheHeaderTells)
{
  const auto withMore = [this](std::size_t count) {
    WriteThree([&](DicomTestData & slice, int number) {
      auto values = MakeValues(static_cast<unsigned int>(number));
      values.resize(values.size() + (number == 1 ? count : 0));
      slice.SetPixels(values);
    });
    return GetRefusal();
  };
  EXPECT_EQ(withMore(0), "");
  EXPECT_EQ(withMore(1), "");
  EXPECT_TRUE(HasWords(withMore(Columns), { "1", "take 32 bytes", "tells of 24" })) << withMore(Columns);
  EXPECT_TRUE(HasWords(withMore(Columns * Rows), { "take 48 bytes" }));
}

TEST_F(DicomPixelsTest, FewerFramesThanTheFileHas)
{
  for (const char * const number : { "1", "2", "4" })
  {
    DicomTestData file = MakeEnhanced();
    file.Set(0x00280008, "IS", number);
    file.Write(m_Folder / "enhanced");
    EXPECT_TRUE(HasWords(GetRefusal(), { "enhanced", "frames" })) << GetRefusal();
  }
  DicomTestData file = MakeEnhanced();
  file.SetPixels(Expect({ 4, 5, 6, 7 }));
  file.Write(m_Folder / "enhanced");
  EXPECT_TRUE(HasWords(GetRefusal(), { "take 96 bytes", "tells of 72" })) << GetRefusal();
}

TEST_F(DicomPixelsTest, CompressedSlices)
{
  for (const auto syntax : { gdcm::TransferSyntax::RLELossless, gdcm::TransferSyntax::JPEGLosslessProcess14_1 })
  {
    WriteThree([](DicomTestData &, int) {});
    for (int i = 0; i < 3; ++i)
    {
      Encode(std::to_string(i), syntax);
    }
    EXPECT_EQ(Read<std::int16_t>(*Open()), Expect({ 0, 1, 2 })) << gdcm::TransferSyntax(syntax);
    const auto size = std::filesystem::file_size(m_Folder / "1");
    for (const std::uintmax_t missing : { 9, 12, 20 })
    {
      std::filesystem::resize_file(m_Folder / "1", size - missing);
      EXPECT_TRUE(HasWords(GetRefusal(), { "1 is truncated" })) << missing << ' ' << gdcm::TransferSyntax(syntax);
    }
  }
}

TEST_F(DicomPixelsTest, SlopesOfEachSlice)
{
  WriteThree([](DicomTestData & slice, int i) {
    slice.SetRescale(i == 0 ? "1" : i == 1 ? "0.9999999975" : "0.5", "0.25");
  });
  EXPECT_EQ(GetComponent(), ElementType::Float);
  const auto   values = Read<float>(*Open());
  const auto   stored = Expect({ 0, 1, 2 });
  const double slopes[] = { 1, 0.9999999975, 0.5 };
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    EXPECT_EQ(values[i], static_cast<float>(slopes[i / (Columns * Rows)] * stored[i] + 0.25));
  }
}

TEST_F(DicomPixelsTest, AMaskWhoseSlopesVaryIsNotZero)
{
  WriteThree([](DicomTestData & slice, int i) {
    slice.SetBits(8, 8, false);
    slice.SetPixels(std::vector<std::uint8_t>(Columns * Rows, 1));
    slice.SetRescale(i == 0 ? "1" : "0.9999999975", "0");
  });
  for (const float value : Read<float>(*Open()))
  {
    EXPECT_NEAR(value, 1, 1e-6);
  }
}

TEST_F(DicomPixelsTest, TheTypeHoldsTheWholeSeries)
{
  const auto rescale = [](const char * slope, const char * intercept, unsigned int stored, bool isSigned) {
    return [=](DicomTestData & slice, int i) {
      slice.SetBits(16, stored, isSigned);
      slice.SetPixels(MakeValues(static_cast<unsigned int>(i), 0, 4095));
      slice.SetRescale(slope, intercept);
    };
  };
  const auto expect = [this](ElementType type, double slope, double intercept) {
    const auto reader = Open();
    EXPECT_EQ(reader->GetDescription().Component, type);
    const auto read = [&](auto tag) {
      std::vector<double> values;
      for (const auto value : Read<typename decltype(tag)::Type>(*reader))
      {
        values.push_back(static_cast<double>(value));
      }
      return values;
    };
    const std::vector<double> values = itk::Subdivision::WithElementType(type, read);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const auto stored = MakeValues(static_cast<unsigned int>(i / (Columns * Rows)), 0, 4095);
      EXPECT_EQ(values[i], slope * stored[i % (Columns * Rows)] + intercept);
    }
  };
  WriteThree(rescale("1", "-1024", 12, false));
  expect(ElementType::Int16, 1, -1024);
  WriteThree(rescale("1", "-1024", 16, false));
  expect(ElementType::Int32, 1, -1024);
  WriteThree(rescale("10", "0", 12, false));
  expect(ElementType::UInt16, 10, 0);
  WriteThree(rescale("1.0", "0", 12, false));
  expect(ElementType::UInt16, 1, 0);
  WriteThree(rescale("2", "1", 16, true));
  expect(ElementType::Int32, 2, 1);
}

TEST_F(DicomPixelsTest, SlicesOfDifferentTypes)
{
  WriteThree([](DicomTestData & slice, int i) {
    if (i == 1)
    {
      slice.SetBits(16, 16, false);
      slice.SetPixels(std::vector<std::uint16_t>(Columns * Rows, 60000));
    }
  });
  const auto reader = Open();
  ASSERT_EQ(reader->GetDescription().Component, ElementType::Int32);
  const auto values = Read<std::int32_t>(*reader);
  EXPECT_EQ(values[Columns * Rows], 60000);
  EXPECT_EQ(values[0], Expect({ 0 })[0]);
}

TEST_F(DicomPixelsTest, BitsThatAreNotStoredAreIgnored)
{
  WriteThree([](DicomTestData & slice, int i) {
    std::vector<std::uint16_t> pixels;
    for (const std::int16_t value : MakeValues(static_cast<unsigned int>(i), -2048, 2047))
    {
      pixels.push_back(static_cast<std::uint16_t>((value & 0xfff) | 0x5000));
    }
    slice.SetBits(16, 12, true);
    slice.SetPixels(pixels);
  });
  std::vector<std::int16_t> expected;
  for (unsigned int i = 0; i < 3; ++i)
  {
    const auto values = MakeValues(i, -2048, 2047);
    expected.insert(expected.end(), values.begin(), values.end());
  }
  EXPECT_EQ(Read<std::int16_t>(*Open()), expected);
}

TEST_F(DicomPixelsTest, KindsOfPixels)
{
  WriteThree([](DicomTestData & slice, int) { slice.Set(0x00280004, "CS", "MONOCHROME1"); });
  EXPECT_EQ(Read<std::int16_t>(*Open()), Expect({ 0, 1, 2 }));
  ASSERT_EQ(m_Warnings.size(), 1U);
  EXPECT_TRUE(HasWords(m_Warnings[0], { "MONOCHROME1" }));
  WriteThree([](DicomTestData & slice, int) { slice.Set(0x00280004, "CS", "PALETTE COLOR"); });
  EXPECT_TRUE(HasWords(GetRefusal(), { "PALETTE COLOR" }));
  WriteThree([](DicomTestData & slice, int) { slice.SetShort(0x00280102, 14); });
  EXPECT_TRUE(HasWords(GetRefusal(), { "up to bit 14" }));
  WriteThree([](DicomTestData & slice, int i) { slice.SetRescale(i == 1 ? "0" : "1", "0"); });
  EXPECT_TRUE(HasWords(GetRefusal(), { "1 has the rescale slope 0" }));
  WriteThree([](DicomTestData & slice, int i) { slice.SetRescale(i == 1 ? "one" : "1", "0"); });
  EXPECT_TRUE(HasWords(GetRefusal(), { "'one'", "is no number" }));
}

TEST_F(DicomPixelsTest, ColoursSideBySideOrInPlanes)
{
  std::vector<std::uint8_t> pixels;
  for (unsigned int i = 0; i < 3 * Columns * Rows; ++i)
  {
    pixels.push_back(static_cast<std::uint8_t>(i));
  }
  for (const bool arePlanes : { false, true })
  {
    WriteThree([&](DicomTestData & slice, int) {
      std::vector<std::uint8_t> stored = pixels;
      for (std::size_t i = 0; arePlanes && i < stored.size(); ++i)
      {
        stored[i] = pixels[i % (Columns * Rows) * 3 + i / (Columns * Rows)];
      }
      slice.Set(0x00280004, "CS", "RGB");
      slice.SetShort(0x00280002, 3);
      slice.SetShort(0x00280006, arePlanes);
      slice.SetBits(8, 8, false);
      slice.SetPixels(stored);
    });
    const auto reader = Open();
    EXPECT_EQ(reader->GetDescription().NumberOfComponents, 3U);
    EXPECT_EQ(reader->GetDescription().Kind, VoxelKind::Rgb);
    const auto values = Read<std::uint8_t>(*reader, { { 0, Columns }, { 0, Rows }, { 1, 1 } });
    EXPECT_EQ(values, pixels);
  }
}

TEST_F(DicomPixelsTest, TruncatedFilesAreNamed)
{
  WriteThree([](DicomTestData &, int) {});
  const auto size = std::filesystem::file_size(m_Folder / "1");
  for (std::uintmax_t left = size - 2 * Columns * Rows; left < size; ++left)
  {
    std::filesystem::resize_file(m_Folder / "1", size);
    std::filesystem::resize_file(m_Folder / "1", left);
    EXPECT_TRUE(HasWords(GetRefusal(), { "1 is truncated" })) << left << " of " << size;
  }
}

TEST_F(DicomPixelsTest, RealPixelsAreToldApartFromMissingOnes)
{
  for (const auto & [tag, kind, bits] : { std::tuple{ 0x7fe00008U, "OF", 32U }, { 0x7fe00009U, "OD", 64U } })
  {
    WriteThree([&, tag = tag, kind = kind, bits = bits](DicomTestData & slice, int) {
      slice.Remove(0x7fe00010);
      slice.SetShort(0x00280100, bits);
      for (const std::uint32_t ofIntegers : { 0x00280101U, 0x00280102U, 0x00280103U })
      {
        slice.Remove(ofIntegers);
      }
      slice.Set(tag, kind, std::string(Columns * Rows * bits / 8, '\0'));
    });
    EXPECT_TRUE(HasWords(GetRefusal(), { "0 holds pixels that are no integers (Float Pixel Data" })) << GetRefusal();
  }
  WriteThree([](DicomTestData & slice, int) { slice.Remove(0x7fe00010); });
  EXPECT_TRUE(HasWords(GetRefusal(), { "has no voxels" }));
}

TEST_F(DicomPixelsTest, FramesOfAnEnhancedFile)
{
  DicomTestData file = MakeEnhanced();
  file.Write(m_Folder / "enhanced.dcm");
  const auto        reader = Open({}, "enhanced.dcm");
  const ImageGrid & grid = reader->GetDescription().Grid;
  EXPECT_EQ(grid.Size, (std::vector<std::uint64_t>{ Columns, Rows, 3 }));
  EXPECT_EQ(grid.Spacing, (std::vector<double>{ 0.5, 0.75, 2 }));
  EXPECT_FALSE(reader->ReadsParts());
  const auto values = Read<std::int32_t>(*reader);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const std::size_t z = i / (Columns * Rows);
    EXPECT_EQ(values[i], static_cast<int>(3 - z) * MakeValues(6 - z)[i % (Columns * Rows)] - 10);
  }
}

TEST_F(DicomPixelsTest, FramesThatAreNoVolumeAreNamed)
{
  DicomTestData file = MakeEnhanced();
  DicomTestData position;
  position.SetPosition(0, 0, 3.3);
  DicomTestData frame;
  frame.SetItems(0x00209113, { position });
  std::vector<DicomTestData> frames(3, frame);
  file.SetItems(0x52009230, frames);
  file.Write(m_Folder / "enhanced.dcm");
  EXPECT_TRUE(HasWords(GetRefusal(), { "3 images stand at each of its 1 positions", "frame 2 of enhanced.dcm" }));
}

TEST_F(DicomPixelsTest, ADose)
{
  DicomTestData file = MakeSlice(1, -5);
  file.Set(0x00280008, "IS", "3");
  file.Set(0x3004000c, "DS", "0\\2.5\\5");
  file.Set(0x3004000e, "DS", "0.001");
  file.SetBits(32, 32, false);
  file.SetPixels(std::vector<std::uint32_t>(3 * Columns * Rows, 4000000001));
  file.Write(m_Folder / "dose.dcm");
  const auto reader = Open();
  EXPECT_EQ(reader->GetDescription().Grid.Spacing[2], 2.5);
  EXPECT_EQ(reader->GetDescription().Grid.Origin[2], -5);
  ASSERT_EQ(reader->GetDescription().Component, ElementType::Double);
  for (const double value : Read<double>(*reader))
  {
    EXPECT_EQ(value, 0.001 * 4000000001);
  }
}

TEST_F(DicomPixelsTest, AUniformOffsetVectorThatIsTooShort)
{
  DicomTestData file = MakeSlice(1, -5);
  file.Set(0x00280008, "IS", "3");
  file.Set(0x3004000c, "DS", "0\\2.5");
  file.SetPixels(Expect({ 1, 2, 3 }));
  file.Write(m_Folder / "dose.dcm");
  EXPECT_TRUE(HasWords(GetRefusal(), { "no position" }));
}

TEST_F(DicomPixelsTest, MetadataNamesThePatientOnlyByDicomKeys)
{
  WriteThree([](DicomTestData & slice, int) {
    slice.SetRescale("1", "0");
    slice.Set(0x00281054, "LO", "HU");
  });
  const auto metadata = Open()->GetDescription().Metadata;
  EXPECT_EQ(metadata.at("Modality"), "CT");
  EXPECT_EQ(metadata.at("Units"), "HU");
  EXPECT_EQ(metadata.at("0010|0010"), "Doe^Jane");
  for (const auto & [key, value] : metadata)
  {
    EXPECT_TRUE(key.find('|') == 4 || key == "Modality" || key == "Units") << key;
    EXPECT_TRUE(key.find('|') == 4 || value.find("Doe") == std::string::npos) << key;
  }
}
