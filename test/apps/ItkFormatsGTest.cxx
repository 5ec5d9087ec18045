// SPDX-License-Identifier: Apache-2.0
// The formats that ITK reads and writes.
#include "TestFolder.h"
#include "VolumeTestImages.h"
#include "formats/CreateVolume.h"
#include "itk/ItkDescription.h"
#include "itk/JpegIntegrity.h"
#include "itk/LibraryReason.h"

#include "itkJPEGImageIO.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

using namespace VolumeTest;
using itk::Subdivision::ElementType;

namespace
{
ImageDescription
MakeUpright(const std::vector<std::uint64_t> & size, ElementType type)
{
  ImageDescription description = MakeDescription(size, type);
  for (std::size_t axis = 0; axis < size.size(); ++axis)
  {
    description.Grid.Directions[axis].assign(size.size(), 0.0);
    description.Grid.Directions[axis][axis] = 1.0;
  }
  return description;
}

/** Writes and reads an image; returns the warnings. */
std::string
WriteAndRead(const std::string & path, const ImageDescription & description)
{
  std::string warnings;
  const auto  voxels = MakeVoxels(description);
  WriteVolume(path, description, voxels, {}, [&](const std::string & text) { warnings += text + "\n"; });
  EXPECT_EQ(ReadAll(path), voxels) << path;
  return warnings;
}
} // namespace

class ItkFormats : public testing::TestWithParam<const char *>
{};

TEST_P(ItkFormats, VoxelsComeBackInCapitalsOrNot)
{
  const TestFolder folder;
  WriteAndRead(folder / (std::string("image") + GetParam()), MakeUpright({ 9, 7, 5 }, ElementType::Int16));
}

TEST_P(ItkFormats, PartsAreThoseOfTheWhole)
{
  const TestFolder  folder;
  const std::string path = folder / (std::string("image") + GetParam());
  const auto        description = MakeUpright({ 9, 7, 5 }, ElementType::Int16);
  const auto        voxels = MakeVoxels(description);
  WriteVolume(path, description, voxels);
  const auto                  reader = Open(path);
  const itk::Subdivision::Box whole = { { 0, 9 }, { 0, 7 }, { 0, 5 } };
  EXPECT_EQ(ReadVoxels(*reader, whole), voxels);
  EXPECT_EQ(ReadVoxels(*reader, whole), voxels);
  const auto plane = static_cast<std::ptrdiff_t>(9 * 7 * 2);
  EXPECT_EQ(ReadVoxels(*reader, { { 0, 9 }, { 0, 7 }, { 1, 2 } }),
            std::vector<char>(voxels.begin() + plane, voxels.begin() + 3 * plane));
  EXPECT_EQ(ReadVoxels(*reader, { { 2, 3 }, { 4, 1 }, { 3, 1 } }),
            std::vector<char>(voxels.begin() + 3 * plane + 4 * 18 + 4, voxels.begin() + 3 * plane + 4 * 18 + 10));
  EXPECT_EQ(ReadVoxels(*reader, whole), voxels);
}

INSTANTIATE_TEST_SUITE_P(Endings,
                         ItkFormats,
                         testing::Values(".nii",
                                         ".nii.gz",
                                         ".NII",
                                         ".NII.GZ",
                                         ".vtk",
                                         ".VTK",
                                         ".gipl",
                                         ".GIPL",
                                         ".gipl.gz",
                                         ".h5",
                                         ".H5",
                                         ".mrc",
                                         ".MRC",
                                         ".hdr",
                                         ".img",
                                         ".img.gz",
                                         ".hdf5",
                                         ".rec"));

TEST(ItkFormatsLimits, WhatIsLostIsSaid)
{
  const TestFolder folder;
  const auto       oblique = MakeDescription({ 9, 7, 5 }, ElementType::Int16);
  EXPECT_EQ(WriteAndRead(folder / "a.nii", oblique), "");
  EXPECT_EQ(WriteAndRead(folder / "a.nii.gz", oblique), "");
  EXPECT_EQ(WriteAndRead(folder / "a.h5", oblique), "");
  EXPECT_NE(WriteAndRead(folder / "a.vtk", oblique).find("cannot hold the directions of the axes"), std::string::npos);
  EXPECT_NE(WriteAndRead(folder / "a.gipl", oblique).find("directions"), std::string::npos);
  const auto upright = MakeUpright({ 9, 7, 5 }, ElementType::Int16);
  EXPECT_EQ(WriteAndRead(folder / "a.vtk", upright), "");
  auto micrometres = upright;
  micrometres.Metadata["DistanceUnits"] = "um";
  EXPECT_NE(WriteAndRead(folder / "a.nii", micrometres).find("the unit um"), std::string::npos);
}

// MINC's directions have three coordinates.
TEST(ItkFormatsLimits, AnImageOfTwoAxesOfMincIsOneOfTwoAxesElsewhere)
{
  const TestFolder folder;
  const auto       flat = MakeUpright({ 9, 7 }, ElementType::Int16);
  EXPECT_EQ(WriteAndRead(folder / "a.mnc", flat), "");
  const ImageDescription read = Open(folder / "a.mnc")->GetDescription();
  EXPECT_EQ(read.Grid.Directions, flat.Grid.Directions);
  for (const std::string name : { "a.mha", "a.nrrd", "a.nii" })
  {
    EXPECT_EQ(WriteAndRead(folder / name, read), "") << name;
    EXPECT_EQ(Open(folder / name)->GetDescription().Grid.Directions, flat.Grid.Directions) << name;
  }
}

TEST(ItkFormatsLimits, AnImageThatLeavesItsAxesHasNoPlacement)
{
  for (const double z : { 0.0, 1e-5, 0.6 })
  {
    const auto imageIO = itk::JPEGImageIO::New();
    imageIO->SetNumberOfDimensions(2);
    imageIO->SetComponentType(itk::IOComponentEnum::UCHAR);
    for (const unsigned int axis : { 0u, 1u })
    {
      imageIO->SetDimensions(axis, 5);
      imageIO->SetOrigin(axis, 3.0);
    }
    imageIO->SetDirection(0, std::vector<double>{ 0.0, -1.0, 0.0 });
    imageIO->SetDirection(1, std::vector<double>{ std::sqrt(1.0 - z * z), 0.0, z });
    std::string     warnings;
    const auto      warn = [&](const std::string & text) { warnings += text; };
    const ImageGrid grid = DescribeByItk("a file", *imageIO, warn).Grid;
    const bool      isLeft = z > 0.1;
    EXPECT_EQ(warnings.find("its origin and directions are left out") != std::string::npos, isLeft) << warnings;
    EXPECT_EQ(grid.Origin, std::vector<double>(2, isLeft ? 0.0 : 3.0));
    ASSERT_EQ(grid.Directions.size(), 2u);
    EXPECT_EQ(grid.Directions[0], isLeft ? std::vector<double>({ 1.0, 0.0 }) : std::vector<double>({ 0.0, -1.0 }));
    EXPECT_EQ(grid.Directions[1].size(), 2u);
    EXPECT_NEAR(grid.Directions[1][isLeft ? 1 : 0], 1.0, 1e-9);
  }
}

// Neither image could be read any more.
TEST(ItkFormatsLimits, APairIsNotPutBesideACompressedOne)
{
  for (const std::string present :
       { "a.hdr", "a.img", "a.hdr.gz", "a.img.gz", "A.HDR", "A.IMG", "A.HDR.GZ", "A.IMG.GZ" })
  {
    const TestFolder folder;
    folder.WriteFile(present, "another image's");
    const bool isCompressed = present.size() > 5;
    const bool isSmall = present[0] == 'a';
    const auto compressed = isSmall ? std::vector<std::string>{ "a.img.gz" } : std::vector<std::string>{ "A.IMG.GZ" };
    const auto plain =
      isSmall ? std::vector<std::string>{ "a.hdr", "a.img" } : std::vector<std::string>{ "A.HDR", "A.IMG" };
    for (const std::string & name : isCompressed ? plain : compressed)
    {
      const auto writer = CreateVolume(folder / name, {}, [](const std::string &) {});
      const auto error = GetError([&] { writer->Begin(MakeUpright({ 9, 7, 5 }, ElementType::UInt8)); });
      EXPECT_NE(error.find("which of both"), std::string::npos) << present << ' ' << name << ": " << error;
    }
  }
}

TEST(ItkFormatsLimits, WhatCannotBeHeldIsRefusedBeforeAnythingIsComputed)
{
  const TestFolder folder;
  const auto       getError = [&](const std::string & name, const ImageDescription & description) {
    const auto writer = CreateVolume(folder / name, {}, [](const std::string &) {});
    return GetError([&] { writer->Begin(description); });
  };
  EXPECT_NE(getError("a.nii", MakeUpright({ 32768, 2, 2 }, ElementType::UInt8)).find("up to 32767"), std::string::npos);
  EXPECT_EQ(getError("a.nii", MakeUpright({ 32767, 2, 2 }, ElementType::UInt8)), "");
  EXPECT_NE(getError("a.nii.gz", MakeUpright({ 2, 2, 40000 }, ElementType::UInt8)).find("up to 32767"),
            std::string::npos);
  EXPECT_NE(getError("a.gipl", MakeUpright({ 65536, 2, 2 }, ElementType::UInt8)).find("up to 65535"),
            std::string::npos);
  EXPECT_NE(getError("a.mrc", MakeUpright({ 65536, 2, 2 }, ElementType::UInt8)).find("up to 65535"), std::string::npos);
  WriteVolume(folder / "a.mrc",
              MakeUpright({ 65535, 1, 1 }, ElementType::UInt8),
              MakeVoxels(MakeUpright({ 65535, 1, 1 }, ElementType::UInt8)));
  EXPECT_EQ(ReadAll(folder / "a.mrc"), MakeVoxels(MakeUpright({ 65535, 1, 1 }, ElementType::UInt8)));
  std::filesystem::remove(folder / "a.mrc");
  auto colours = MakeUpright({ 9, 7, 5 }, ElementType::UInt8);
  colours.NumberOfComponents = 3;
  colours.Kind = VoxelKind::Rgb;
  EXPECT_NE(getError("a.gipl", colours).find("there: its format cannot hold such voxels"), std::string::npos);
  EXPECT_NE(getError("a.png", MakeUpright({ 9, 7, 5 }, ElementType::UInt8)), "");
  EXPECT_NE(getError("a.png", MakeUpright({ 9, 7 }, ElementType::Float)), "");
  EXPECT_NE(getError("a.vtk", MakeUpright({ 9, 7, 5, 3 }, ElementType::UInt8)), "");
  for (const unsigned int components : { 2u, 4u, 5u })
  {
    auto description = MakeUpright({ 9, 7 }, ElementType::UInt8);
    description.NumberOfComponents = components;
    description.Kind = components == 4 ? VoxelKind::Rgba : VoxelKind::Vector;
    for (const std::string name : { "a.bmp", "a.jpg", "a.JPEG" })
    {
      EXPECT_NE(getError(name, description).find("3 components, not " + std::to_string(components)), std::string::npos);
    }
    EXPECT_EQ(getError("a.png", description) == "", components < 5);
    EXPECT_EQ(getError("a.tif", description), "");
  }
  EXPECT_TRUE(folder.GetFiles().empty());
}

// What JPEG makes of so few voxels would not tell that it changes others.
TEST(ItkFormatsLimits, JpegFilesOfAnySizeAreWritten)
{
  const TestFolder folder;
  for (const std::uint64_t size : { 1u, 2u, 7u, 8u, 9u, 16u, 40u })
  {
    const ImageDescription description = MakeUpright({ size, size }, ElementType::UInt8);
    std::string            warnings;
    WriteVolume(
      folder / "a.jpg", description, MakeVoxels(description), {}, [&](const std::string & text) { warnings += text; });
    EXPECT_NE(warnings.find("changes the values of voxels"), std::string::npos) << size;
    EXPECT_EQ(Open(folder / "a.jpg")->GetDescription().Grid.Size, description.Grid.Size);
  }
}

TEST(ItkFormatsLimits, AnUnknownEndingListsTheKnownOnes)
{
  const std::string error = GetError([] { CreateVolume("image.xyz", {}, [](const std::string &) {}); });
  EXPECT_NE(error.find(".nrrd"), std::string::npos);
  EXPECT_NE(error.find(".nii.gz"), std::string::npos);
}

// ITK mixes up the components of a part of a NIfTI's vectors.
TEST(ItkFormatsLimits, VectorsOfNiftiAreReadRight)
{
  const TestFolder folder;
  auto             description = MakeUpright({ 9, 7, 5 }, ElementType::Float);
  description.NumberOfComponents = 3;
  description.Kind = VoxelKind::Vector;
  const auto voxels = MakeVoxels(description);
  WriteVolume(folder / "a.nii", description, voxels);
  const auto reader = Open(folder / "a.nii");
  const auto plane = static_cast<std::ptrdiff_t>(9 * 7 * 12);
  EXPECT_EQ(ReadVoxels(*reader, { { 0, 9 }, { 0, 7 }, { 2, 1 } }),
            std::vector<char>(voxels.begin() + 2 * plane, voxels.begin() + 3 * plane));
}

TEST(ItkFormatsLimits, ReasonsHaveNoPlacesInTheCode)
{
  const auto getReason = [](const std::string & text) { return GetReason(std::runtime_error(text), "/a/b.nrrd"); };
  EXPECT_EQ(
    getReason("itk::ERROR: NrrdImageIO(0x55e81b31fd40): ReadImageInformation: Error reading /a/b.nrrd:\n[nrrd] "
              "nrrdLoad: trouble reading \"/a/b.nrrd\"\n[nrrd] _nrrdFormatNRRD_read:\n[nrrd] _nrrdRead: fread got "
              "only 629"),
    "fread got only 629");
  EXPECT_EQ(getReason("ITK ERROR: ImageIO(0x55): Read: nothing there"), "nothing there");
  EXPECT_EQ(getReason("/a/b.nrrd is not recognized as a NIFTI file"), "it is not recognized as a NIFTI file");
  EXPECT_EQ(getReason("Unknown component type: itk::CommonEnums::IOComponent::UNKNOWNCOMPONENTTYPE"),
            "its voxels are of a type that is not supported");
  EXPECT_EQ(getReason("Unrecognized mode"), "Unrecognized mode");
}

TEST(ItkFormatsLimits, CmykIsNotTakenForOtherColours)
{
  const TestFolder                folder;
  const std::vector<std::uint8_t> pixels(4 * 16 * 16, 100);
  std::filesystem::create_directory(folder / "slices");
  for (const std::string name : { "a.jpg", "slices/a1.jpg", "slices/a2.jpg" })
  {
    const auto jpeg = itk::JPEGImageIO::New();
    jpeg->SetFileName(folder / name);
    jpeg->SetNumberOfDimensions(2);
    jpeg->SetDimensions(0, 16);
    jpeg->SetDimensions(1, 16);
    jpeg->SetComponentType(itk::IOComponentEnum::UCHAR);
    jpeg->SetNumberOfComponents(4);
    jpeg->Write(pixels.data());
  }
  EXPECT_NE(GetError([&] { Open(folder / "a.jpg"); }).find("CMYK"), std::string::npos);
  EXPECT_NE(GetError([&] { Open(folder / "slices"); }).find("a1.jpg: its colours are CMYK"), std::string::npos);
}

// The library would first make room for all that the header tells of.
TEST(ItkFormats, AJpegFileWithTooFewBitsForItsSizeIsTruncated)
{
  const TestFolder                 folder;
  const std::vector<unsigned char> pixels(16 * 16, 100);
  const std::string                path = folder / "a.jpg";
  const auto                       jpeg = itk::JPEGImageIO::New(); // progressive
  jpeg->SetFileName(path);
  jpeg->SetNumberOfDimensions(2);
  jpeg->SetDimensions(0, 16);
  jpeg->SetDimensions(1, 16);
  jpeg->SetComponentType(itk::IOComponentEnum::UCHAR);
  jpeg->SetNumberOfComponents(1);
  jpeg->Write(pixels.data());
  EXPECT_EQ(FindJpegFault(path), "");

  std::string       text = folder.ReadFile("a.jpg");
  const std::size_t frame = text.find("\xff\xc2");
  ASSERT_NE(frame, std::string::npos);
  text.replace(frame + 5, 4, "\xff\xdc\xff\xdc", 4); // 65500 rows and columns
  folder.WriteFile("a.jpg", text);
  EXPECT_EQ(FindJpegFault(path), "Premature end of input file");
}

TEST(ItkFormatsLimits, ATruncatedFileIsNoticed)
{
  const TestFolder folder;
  const auto       description = MakeUpright({ 9, 7, 5 }, ElementType::Int16);
  for (const std::string name : { "a.nii", "a.nii.gz", "a.vtk", "a.gipl", "a.mrc", "a.h5" })
  {
    WriteVolume(folder / name, description, MakeVoxels(description));
    const std::string content = folder.ReadFile(name);
    for (const std::size_t lost : { std::size_t{ 1 }, std::size_t{ 200 }, content.size() / 2, content.size() - 10 })
    {
      folder.WriteFile(name, content.substr(0, content.size() - lost));
      EXPECT_NE(GetError([&] { ReadAll(folder / name); }), "") << name << " less " << lost << " bytes";
    }
  }
}
