// SPDX-License-Identifier: Apache-2.0
#include "TestFolder.h"
#include "TiffTestFile.h"
#include "VolumeTestAccess.h"
#include "plain/RawReader.h"

#include <gtest/gtest.h>

using itk::Subdivision::Box;
using itk::Subdivision::ElementType;

TEST(RawLayout, IsParsed)
{
  const RawLayout plain = ParseRawLayout("1024x512x800:uint16");
  EXPECT_EQ(plain.Size, (std::vector<std::uint64_t>{ 1024, 512, 800 }));
  EXPECT_EQ(plain.Component, ElementType::UInt16);
  EXPECT_EQ(plain.NumberOfComponents, 1u);
  EXPECT_FALSE(plain.IsBigEndian);
  EXPECT_EQ(plain.HeaderBytes, 0u);
  const RawLayout full = ParseRawLayout("3x4x5x6:float64:3:big+512");
  EXPECT_EQ(full.Size, (std::vector<std::uint64_t>{ 3, 4, 5, 6 }));
  EXPECT_EQ(full.Component, ElementType::Double);
  EXPECT_EQ(full.NumberOfComponents, 3u);
  EXPECT_TRUE(full.IsBigEndian);
  EXPECT_EQ(full.HeaderBytes, 512u);
}

TEST(RawLayout, RefusesWhatIsNone)
{
  for (const std::string text : { "",
                                  "4",
                                  "4:uint8",
                                  "4x4",
                                  "4x4:",
                                  "4x4:uint",
                                  "0x4:uint8",
                                  "4x:uint8",
                                  "4xx4:uint8",
                                  "-4x4:uint8",
                                  " 4x4:uint8",
                                  "4x4:uint8:",
                                  "4x4:uint8:0",
                                  "4x4:uint8:bigger",
                                  "4x4:uint8+",
                                  "4x4:uint8+-1",
                                  "4x4:uint8+1+1",
                                  "1x2x3x4x5:uint8",
                                  "4294967296x4294967296:uint8" })
  {
    EXPECT_THROW(ParseRawLayout(text), std::invalid_argument) << text;
  }
}

TEST(RawReader, ReadsPartsInEitherOrderOfBytes)
{
  const TestFolder folder;
  const auto       voxels = MakeVoxels<std::int32_t>(5 * 3 * 4);
  for (const bool isBigEndian : { false, true })
  {
    folder.WriteFile("a.vol", "header" + ToBytes(voxels, isBigEndian));
    InputOptions options;
    options.Raw = ParseRawLayout(isBigEndian ? "5x3x4:int32:big+6" : "5x3x4:int32+6");
    options.Spacing = std::vector<double>{ 0.5 };
    KeptWarnings warnings;
    const auto   reader = OpenRaw(folder / "a.vol", options, warnings.GetSink());
    EXPECT_EQ(warnings.GetNumber(), 0u);
    EXPECT_EQ(reader->GetDescription().Grid.Spacing, (std::vector<double>{ 0.5, 0.5, 0.5 }));
    EXPECT_EQ(ReadAll<std::int32_t>(*reader), voxels);
    EXPECT_EQ(ReadBox<std::int32_t>(*reader, Box{ { 3, 2 }, { 1, 2 }, { 2, 2 } }),
              (std::vector<std::int32_t>{
                voxels[38], voxels[39], voxels[43], voxels[44], voxels[53], voxels[54], voxels[58], voxels[59] }));
    EXPECT_EQ(ReadBox<std::int32_t>(*reader, Box{ { 0, 5 }, { 2, 1 }, { 3, 1 } }),
              std::vector<std::int32_t>(voxels.begin() + 55, voxels.end()));
  }
}

TEST(RawReader, WantsTheExactSize)
{
  const TestFolder folder;
  InputOptions     options;
  options.Raw = ParseRawLayout("5x3:uint16+2");
  KeptWarnings warnings;
  for (const std::size_t size : { 0, 1, 31, 33 })
  {
    folder.WriteFile("a.raw", std::string(size, 'x'));
    const std::string error = GetError([&] { OpenRaw(folder / "a.raw", options, warnings.GetSink()); });
    EXPECT_TRUE(Contains(error, "it has " + std::to_string(size) + " bytes")) << error;
    EXPECT_TRUE(Contains(error, "2 + 30")) << error;
  }
  folder.WriteFile("a.raw", std::string(32, 'x'));
  EXPECT_EQ(GetError([&] { OpenRaw(folder / "a.raw", options, warnings.GetSink()); }), "");
}
