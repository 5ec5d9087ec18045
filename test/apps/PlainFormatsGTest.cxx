// SPDX-License-Identifier: Apache-2.0
// MetaImage and NRRD: what is written is what ITK reads, and what ITK writes is what is read.
#include "TestFolder.h"
#include "VolumeTestImages.h"
#include "formats/CreateVolume.h"

#include "itk/ItkReader.h"
#include "text/HeaderText.h"

#include <gtest/gtest.h>

using namespace VolumeTest;
using itk::Subdivision::Box;
using itk::Subdivision::ElementType;

namespace
{
void
ExpectSameGrid(const ImageGrid & found, const ImageGrid & meant)
{
  ASSERT_EQ(found.Size, meant.Size);
  for (std::size_t axis = 0; axis < meant.Size.size(); ++axis)
  {
    EXPECT_NEAR(found.Spacing[axis], meant.Spacing[axis], 1e-12);
    EXPECT_NEAR(found.Origin[axis], meant.Origin[axis], 1e-12);
    for (std::size_t i = 0; i < meant.Size.size(); ++i)
    {
      EXPECT_NEAR(found.Directions[axis][i], meant.Directions[axis][i], 1e-12) << "axis " << axis;
    }
  }
}

class PlainFormats : public testing::TestWithParam<std::tuple<std::string, bool>>
{};
} // namespace

TEST_P(PlainFormats, BothReadersFindWhatWasWritten)
{
  const auto [ending, compress] = GetParam();
  for (const auto & size : std::vector<std::vector<std::uint64_t>>{ { 17 }, { 9, 5 }, { 7, 6, 5 }, { 5, 4, 3, 2 } })
  {
    for (const ElementType type : { ElementType::UInt8,
                                    ElementType::Int16,
                                    ElementType::UInt32,
                                    ElementType::Int64,
                                    ElementType::Float,
                                    ElementType::Double })
    {
      for (const unsigned int components : { 1u, 3u })
      {
        SCOPED_TRACE(std::string(GetName(type)) + " axes " + std::to_string(size.size()) + " components " +
                     std::to_string(components));
        const TestFolder       folder;
        const std::string      path = folder / ("image" + ending);
        const ImageDescription description = MakeDescription(size, type, components);
        const auto             voxels = MakeVoxels(description);
        OutputOptions          options;
        options.Compress = compress;
        WriteVolume(path, description, voxels, options);

        const auto own = Open(path);
        // ITK knows no endings in capitals, and takes data files by the names in the header.
        const std::string plainPath = folder / ("image" + ToLower(ending));
        std::filesystem::rename(path, plainPath);
        ItkReader itkReader(plainPath);
        for (VolumeReader * const reader : { own.get(), static_cast<VolumeReader *>(&itkReader) })
        {
          ExpectSameGrid(reader->GetDescription().Grid, description.Grid);
          EXPECT_EQ(reader->GetDescription().Component, type);
          EXPECT_EQ(reader->GetDescription().NumberOfComponents, components);
          EXPECT_EQ(ReadVoxels(*reader, GetWholeBox(size)), voxels);
        }
      }
    }
  }
}

// Boxes of every shape, from stored and compressed voxels, forward and back.
TEST_P(PlainFormats, PartsAreThoseOfTheWhole)
{
  const auto [ending, compress] = GetParam();
  const TestFolder       folder;
  const std::string      path = folder / ("image" + ending);
  const ImageDescription description = MakeDescription({ 40, 30, 20 }, ElementType::UInt16, 2);
  const auto             voxels = MakeVoxels(description);
  OutputOptions          options;
  options.Compress = compress;
  WriteVolume(path, description, voxels, options);
  const auto reader = Open(path);
  EXPECT_TRUE(reader->ReadsParts());
  for (const Box & box : std::vector<Box>{ { { 0, 40 }, { 0, 30 }, { 0, 7 } },
                                           { { 0, 40 }, { 0, 30 }, { 5, 9 } },
                                           { { 0, 40 }, { 0, 30 }, { 12, 8 } },
                                           { { 0, 40 }, { 3, 5 }, { 2, 1 } },
                                           { { 11, 13 }, { 7, 2 }, { 18, 2 } },
                                           { { 39, 1 }, { 29, 1 }, { 19, 1 } },
                                           { { 1, 3 }, { 0, 30 }, { 0, 20 } } })
  {
    std::vector<char> expected;
    for (std::uint64_t z = 0; z < box[2].Size; ++z)
    {
      for (std::uint64_t y = 0; y < box[1].Size; ++y)
      {
        const std::uint64_t row = (box[2].First + z) * 30 + box[1].First + y;
        const auto          first = voxels.begin() + static_cast<std::ptrdiff_t>((row * 40 + box[0].First) * 4);
        expected.insert(expected.end(), first, first + static_cast<std::ptrdiff_t>(box[0].Size * 4));
      }
    }
    EXPECT_EQ(ReadVoxels(*reader, box), expected);
  }
}

// The same bytes whether written at once or in parts, by one thread or several.
TEST_P(PlainFormats, PartsAndThreadsMakeNoDifference)
{
  const auto [ending, compress] = GetParam();
  const TestFolder       folder;
  const ImageDescription description = MakeDescription({ 300, 200, 40 }, ElementType::UInt16);
  const auto             voxels = MakeVoxels(description);
  OutputOptions          options;
  options.Compress = compress;
  const std::string name = std::string("image") + ending;
  WriteVolume(folder / name, description, voxels, options);
  const auto files = folder.GetFiles();

  options.Threads = 3;
  const auto writer = CreateVolume(folder / name, options, [](const std::string &) {});
  ASSERT_TRUE(writer->WritesParts());
  writer->Begin(description);
  const std::size_t plane = 300 * 200 * 2;
  std::int64_t      z = 0;
  for (const std::uint64_t count : { 1, 16, 3, 20 })
  {
    writer->Write({ { 0, 300 }, { 0, 200 }, { z, count } }, voxels.data() + static_cast<std::size_t>(z) * plane);
    z += static_cast<std::int64_t>(count);
  }
  writer->Commit();
  EXPECT_TRUE(folder.GetFiles() == files);
}

// NRRD says what the components mean, where it has a kind for so many of them.
TEST(NrrdKinds, BothReadersFindTheMeaningOfComponents)
{
  struct Meaning
  {
    VoxelKind    Written;
    unsigned int Components;
    VoxelKind    Read;
  };
  const std::vector<Meaning> meanings = { { VoxelKind::Rgb, 3, VoxelKind::Rgb },
                                          { VoxelKind::Rgba, 4, VoxelKind::Rgba },
                                          { VoxelKind::Complex, 2, VoxelKind::Complex },
                                          { VoxelKind::Vector, 6, VoxelKind::Vector },
                                          { VoxelKind::Vector, 7, VoxelKind::Vector },
                                          { VoxelKind::SymmetricTensor, 6, VoxelKind::SymmetricTensor },
                                          { VoxelKind::SymmetricTensor, 3, VoxelKind::Vector },
                                          { VoxelKind::Rgb, 5, VoxelKind::Vector } };
  for (const auto & [written, components, read] : meanings)
  {
    for (const std::string name : { "image.nrrd", "image.nhdr" })
    {
      const TestFolder folder;
      ImageDescription description = MakeDescription({ 5, 4, 3 }, ElementType::Float, components);
      description.Kind = written;
      const auto voxels = MakeVoxels(description);
      WriteVolume(folder / name, description, voxels);
      const auto own = Open(folder / name);
      ItkReader  itkReader(folder / name);
      for (VolumeReader * const reader : { own.get(), static_cast<VolumeReader *>(&itkReader) })
      {
        EXPECT_EQ(reader->GetDescription().Kind, read) << components;
        EXPECT_EQ(reader->GetDescription().NumberOfComponents, components);
        ExpectSameGrid(reader->GetDescription().Grid, description.Grid);
        EXPECT_EQ(ReadVoxels(*reader, GetWholeBox({ 5, 4, 3 })), voxels);
      }
      EXPECT_TRUE(own->ReadsParts());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Endings,
                         PlainFormats,
                         testing::Combine(testing::Values(".mha", ".mhd", ".nrrd", ".nhdr", ".MHA", ".NRRD"),
                                          testing::Bool()));
