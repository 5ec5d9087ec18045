// SPDX-License-Identifier: Apache-2.0
#include "TestFolder.h"
#include "VolumeTestAccess.h"
#include "slices/SliceFolder.h"
#include "slices/SliceFolderWriter.h"
#include "tiff/TiffReader.h"
#include "tiff/TiffWriter.h"

#include <gtest/gtest.h>

using itk::Subdivision::Box;
using itk::Subdivision::ElementType;

namespace
{
constexpr std::uint64_t Width = 300;
constexpr std::uint64_t Height = 7;
constexpr std::uint64_t Slices = 12;

ImageDescription
MakeDescription(ElementType type)
{
  ImageDescription description;
  description.Grid.Size = { Width, Height, Slices };
  description.Grid.Spacing = { 0.02, 0.025, 0.05 };
  description.Grid.Origin = { 0.0, 0.0, 0.0 };
  description.Grid.Directions = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
  description.Component = type;
  return description;
}

/** Writes slice by slice, the fifth one in rows, the last three at once. */
template <typename T>
void
WriteInParts(VolumeWriter & writer, const std::vector<T> & voxels)
{
  for (std::uint64_t z = 0; z < Slices - 3; ++z)
  {
    const std::uint64_t rows = z == 4 ? 3 : Height;
    for (std::uint64_t y = 0; y < Height; y += rows)
    {
      const std::uint64_t count = std::min(rows, Height - y);
      const Box box{ { 0, Width }, { static_cast<std::int64_t>(y), count }, { static_cast<std::int64_t>(z), 1 } };
      writer.Write(box, voxels.data() + (z * Height + y) * Width);
    }
  }
  writer.Write(Box{ { 0, Width }, { 0, Height }, { Slices - 3, 3 } }, voxels.data() + (Slices - 3) * Height * Width);
}

OutputOptions
MakeOptions(bool compress, unsigned int threads)
{
  OutputOptions options;
  options.Compress = compress;
  options.CompressionLevel = 2;
  options.Threads = threads;
  return options;
}

class TiffWriterTest : public ::testing::Test
{
protected:
  std::unique_ptr<VolumeWriter>
  Begin(const std::string & name, const ImageDescription & description, const OutputOptions & options = {})
  {
    auto writer = name.back() == '/' ? CreateSliceFolder(m_Folder / name, options, m_Warnings.GetSink())
                                     : CreateTiff(m_Folder / name, options, m_Warnings.GetSink());
    writer->Begin(description);
    return writer;
  }

  std::unique_ptr<VolumeReader>
  Open(const std::string & name)
  {
    return name.back() == '/' ? OpenSliceFolder(m_Folder / name, {}, m_Warnings.GetSink())
                              : OpenTiff(m_Folder / name, {}, m_Warnings.GetSink());
  }

  TestFolder   m_Folder;
  KeptWarnings m_Warnings;
};

template <typename T>
class TiffWriterTypeTest : public TiffWriterTest
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
} // namespace
TYPED_TEST_SUITE(TiffWriterTypeTest, ElementTypes);

TYPED_TEST(TiffWriterTypeTest, WritesWhatIsReadAgain)
{
  const auto type = itk::Subdivision::ElementTypeOf<TypeParam>();
  const auto voxels = MakeVoxels<TypeParam>(Width * Height * Slices);
  for (const std::string name : { "out/", "out.tif" })
  {
    for (const bool compress : { false, true })
    {
      const auto writer = this->Begin(name, MakeDescription(type), MakeOptions(compress, 2));
      WriteInParts(*writer, voxels);
      writer->Commit();
      const auto reader = this->Open(name);
      EXPECT_EQ(reader->GetDescription().Component, type);
      EXPECT_EQ(reader->GetDescription().Grid.Size, MakeDescription(type).Grid.Size);
      EXPECT_EQ(reader->GetDescription().Grid.Spacing, MakeDescription(type).Grid.Spacing);
      EXPECT_EQ(ReadAll<TypeParam>(*reader), voxels);
    }
  }
  EXPECT_EQ(this->m_Warnings.GetNumber(), 0u);
  EXPECT_EQ(this->m_Folder.GetFiles().size(), 2u);
}

TEST_F(TiffWriterTest, CompressesTheSameForAnyNumberOfThreads)
{
  const std::vector<std::uint16_t> voxels(Width * Height * Slices, 1000);
  for (const unsigned int threads : { 1u, 3u })
  {
    const auto writer = this->Begin(
      "t" + std::to_string(threads) + '/', MakeDescription(ElementType::UInt16), MakeOptions(true, threads));
    writer->Write(Box{ { 0, Width }, { 0, Height }, { 0, Slices } }, voxels.data());
    writer->Commit();
  }
  for (std::uint64_t slice = 0; slice < Slices; ++slice)
  {
    const std::string number = std::string(slice < 10 ? "_000" : "_00") + std::to_string(slice) + ".tif";
    const std::string one = m_Folder.ReadFile("t1/t1" + number);
    EXPECT_EQ(one, m_Folder.ReadFile("t3/t3" + number));
    EXPECT_GT(one.size(), 100u);
    EXPECT_LT(one.size(), Width * Height);
  }
}

TEST_F(TiffWriterTest, LeavesNothingUnlessItIsComplete)
{
  const std::vector<std::uint8_t> voxels(Width * Height * Slices);
  for (const std::string name : { "out/", "out.tif" })
  {
    {
      const auto writer = this->Begin(name, MakeDescription(ElementType::UInt8));
      writer->Write(Box{ { 0, Width }, { 0, Height }, { 0, 1 } }, voxels.data());
      EXPECT_TRUE(Contains(GetError([&] { writer->Commit(); }), "1 of 12 slices"));
    }
    EXPECT_TRUE(m_Folder.GetFiles().empty());
    const auto writer = this->Begin(name, MakeDescription(ElementType::UInt8));
    EXPECT_TRUE(Contains(GetError([&] { writer->Write(Box{ { 0, Width }, { 0, Height }, { 1, 1 } }, voxels.data()); }),
                         "do not continue"));
  }
}

TEST_F(TiffWriterTest, ReplacesEarlierOutputAlone)
{
  const std::vector<std::uint8_t> voxels(Width * Height * Slices, 7);
  const Box                       all{ { 0, Width }, { 0, Height }, { 0, Slices } };
  auto                            fewer = MakeDescription(ElementType::UInt8);
  fewer.Grid.Size[2] = 2;
  std::filesystem::create_directory(m_Folder / "out");
  auto writer = this->Begin("out/", MakeDescription(ElementType::UInt8));
  writer->Write(all, voxels.data());
  writer->Commit();
  writer = this->Begin("out/", fewer);
  writer->Write(Box{ { 0, Width }, { 0, Height }, { 0, 2 } }, voxels.data());
  writer->Commit();
  EXPECT_EQ(this->Open("out/")->GetDescription().Grid.Size[2], 2u);

  // What systems leave in folders goes on to the next one.
  for (const std::string name : { ".DS_Store", "Thumbs.db", "desktop.ini", "._out_0000.tif" })
  {
    m_Folder.WriteFile("out/" + name, "of " + name);
  }
  writer = this->Begin("out/", fewer);
  writer->Write(Box{ { 0, Width }, { 0, Height }, { 0, 2 } }, voxels.data());
  m_Folder.WriteFile("out/.DS_Store", "another");
  writer->Commit();
  EXPECT_EQ(m_Folder.ReadFile("out/.DS_Store"), "another");
  EXPECT_EQ(m_Folder.ReadFile("out/Thumbs.db"), "of Thumbs.db");
  EXPECT_EQ(m_Folder.ReadFile("out/desktop.ini"), "of desktop.ini");
  EXPECT_EQ(m_Folder.ReadFile("out/._out_0000.tif"), "of ._out_0000.tif");
  EXPECT_EQ(this->Open("out/")->GetDescription().Grid.Size[2], 2u);
  std::filesystem::create_directory(m_Folder / "out/._folder");
  EXPECT_TRUE(Contains(GetError([&] { this->Begin("out/", fewer); }), "._folder"));
  std::filesystem::remove(m_Folder / "out/._folder");

  // A file of other origin stays, whatever its name.
  for (const std::string name : { "notes.txt", "out_0007.tif" })
  {
    m_Folder.WriteFile("out/" + name, "precious");
    EXPECT_TRUE(Contains(GetError([&] { this->Begin("out/", fewer); }), name));
    EXPECT_EQ(m_Folder.ReadFile("out/" + name), "precious");
    std::filesystem::remove(m_Folder / ("out/" + name));
  }
  m_Folder.WriteFile("file", "precious");
  EXPECT_TRUE(Contains(GetError([&] { this->Begin("file/", fewer); }), "a file has that name"));
  EXPECT_EQ(m_Folder.GetFiles().size(), 2u);
}

TEST_F(TiffWriterTest, KeepsAFileThatComesMeanwhile)
{
  auto description = MakeDescription(ElementType::UInt8);
  description.Grid.Size[2] = 1;
  std::filesystem::create_directory(m_Folder / "out");
  const auto                      writer = this->Begin("out/", description);
  const std::vector<std::uint8_t> voxels(Width * Height);
  writer->Write(Box{ { 0, Width }, { 0, Height }, { 0, 1 } }, voxels.data());
  m_Folder.WriteFile("out/notes.txt", "precious");
  EXPECT_TRUE(Contains(GetError([&] { writer->Commit(); }), "notes.txt"));
  EXPECT_EQ(m_Folder.ReadFile("out/notes.txt"), "precious");
}

TEST_F(TiffWriterTest, TellsWhatTiffCannotHold)
{
  auto description = MakeDescription(ElementType::UInt8);
  description.Grid.Origin[1] = 4.0;
  this->Begin("out.tif", description);
  EXPECT_TRUE(m_Warnings.Mention("origin"));
  description.Kind = VoxelKind::Complex;
  EXPECT_TRUE(Contains(GetError([&] { this->Begin("out.tif", description); }), "complex"));
  description = MakeDescription(ElementType::UInt8);
  description.Grid.Size.push_back(2);
  EXPECT_TRUE(Contains(GetError([&] { this->Begin("out/", description); }), "not of 4"));
}

TEST_F(TiffWriterTest, KeepsColours)
{
  auto description = MakeDescription(ElementType::UInt8);
  description.NumberOfComponents = 4;
  description.Kind = VoxelKind::Rgba;
  const auto voxels = MakeVoxels<std::uint8_t>(4 * Width * Height * Slices);
  for (const std::string name : { "out/", "out.tif" })
  {
    const auto writer = this->Begin(name, description, MakeOptions(true, 2));
    writer->Write(Box{ { 0, Width }, { 0, Height }, { 0, Slices } }, voxels.data());
    writer->Commit();
    const auto reader = this->Open(name);
    EXPECT_EQ(reader->GetDescription().Kind, VoxelKind::Rgba);
    EXPECT_EQ(ReadAll<std::uint8_t>(*reader), voxels);
  }
}

// A MetaImage does not say what its components are: programs take three or four for colours, and so does TIFF.
TEST_F(TiffWriterTest, ThreeOrFourComponentsThatCanBeColoursAre)
{
  const auto getKind = [&](ElementType type, unsigned int components) {
    auto description = MakeDescription(type);
    description.NumberOfComponents = components;
    description.Kind = VoxelKind::Vector;
    const std::vector<std::uint8_t> voxels = MakeVoxels<std::uint8_t>(description.GetBytes());
    const auto                      writer = this->Begin("out.tif", description);
    writer->Write(Box{ { 0, Width }, { 0, Height }, { 0, Slices } }, voxels.data());
    writer->Commit();
    const auto                reader = this->Open("out.tif");
    std::vector<std::uint8_t> read(voxels.size());
    reader->Read(GetWholeBox(*reader), read.data());
    EXPECT_EQ(read, voxels);
    EXPECT_EQ(reader->GetDescription().Grid.Size, description.Grid.Size);
    return reader->GetDescription().Kind;
  };
  for (const auto type : { ElementType::UInt8, ElementType::UInt16 })
  {
    EXPECT_EQ(getKind(type, 2), VoxelKind::Vector);
    EXPECT_EQ(getKind(type, 3), VoxelKind::Rgb);
    EXPECT_EQ(getKind(type, 4), VoxelKind::Rgba);
    EXPECT_EQ(getKind(type, 5), VoxelKind::Vector);
  }
  for (const auto type : { ElementType::Int8, ElementType::Int16, ElementType::Float })
  {
    EXPECT_EQ(getKind(type, 3), VoxelKind::Vector);
  }
}
