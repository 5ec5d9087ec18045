// SPDX-License-Identifier: Apache-2.0
// Headers as other programs write them.
#include "TestFolder.h"
#include "VolumeTestImages.h"

#include "headers/NrrdHeader.h"
#include "itk/ItkReader.h"

#include <gtest/gtest.h>

#include <tuple>

using namespace VolumeTest;
using itk::Subdivision::ElementType;

namespace
{
/** 0, 1, 2, ... as 16-bit voxels in a row. */
std::string
CountUp(int first, int count, bool isBigEndian = false)
{
  std::string bytes;
  for (int i = first; i < first + count; ++i)
  {
    const char low = static_cast<char>(i & 255);
    const char high = static_cast<char>(i >> 8);
    bytes += isBigEndian ? std::string{ high, low } : std::string{ low, high };
  }
  return bytes;
}

std::vector<char>
AsVoxels(const std::string & bytes)
{
  return { bytes.begin(), bytes.end() };
}

std::string
MakeMetaHeader(const std::string & size, const std::string & dataFile, const std::string & more = "")
{
  return "ObjectType = Image\nNDims = 3\nDimSize = " + size + "\n" + more +
         "ElementType = MET_USHORT\nElementDataFile = " + dataFile + "\n";
}

std::string
MakeNrrdHeader(const std::string & sizes, const std::string & more)
{
  return "NRRD0004\ntype: unsigned short\ndimension: " +
         std::to_string(std::count(sizes.begin(), sizes.end(), ' ') + 1) + "\nsizes: " + sizes + "\nencoding: raw\n" +
         more;
}
} // namespace

TEST(MetaLayouts, BytesInEitherOrder)
{
  const TestFolder folder;
  folder.WriteFile("a.mha",
                   MakeMetaHeader("3 4 5", "LOCAL", "BinaryDataByteOrderMSB = True\n") + CountUp(250, 60, true));
  EXPECT_EQ(ReadAll(folder / "a.mha"), AsVoxels(CountUp(250, 60)));
}

TEST(MetaLayouts, ListOfFiles)
{
  const TestFolder folder;
  std::string      header = MakeMetaHeader("3 4 5", "LIST");
  for (int z = 0; z < 5; ++z)
  {
    const std::string name = "slice " + std::to_string(z) + ".raw";
    header += name + "\n";
    folder.WriteFile(name, CountUp(12 * z, 12));
  }
  folder.WriteFile("a.mhd", header);
  EXPECT_EQ(ReadAll(folder / "a.mhd"), AsVoxels(CountUp(0, 60)));

  std::filesystem::remove(folder / "slice 3.raw");
  EXPECT_NE(GetError([&] { Open(folder / "a.mhd"); }).find("slice 3.raw: No such file"), std::string::npos);
  folder.WriteFile("slice 3.raw", CountUp(0, 11));
  EXPECT_NE(GetError([&] { Open(folder / "a.mhd"); }).find("truncated, with 22 of 24 bytes"), std::string::npos);
  folder.WriteFile("slice 3.raw", CountUp(0, 13));
  EXPECT_NE(GetError([&] { Open(folder / "a.mhd"); }).find("holds 26 bytes"), std::string::npos);
}

TEST(MetaLayouts, ListThatIsTooShortOrTooLong)
{
  const TestFolder folder;
  folder.WriteFile("s.raw", CountUp(0, 12));
  for (const char * const names : { "s.raw\ns.raw\n", "s.raw\ns.raw\ns.raw\ns.raw\n", "" })
  {
    folder.WriteFile("a.mhd", MakeMetaHeader("3 4 3", "LIST") + names);
    EXPECT_NE(GetError([&] { Open(folder / "a.mhd"); }).find("data files instead of 3"), std::string::npos);
  }
  folder.WriteFile("a.mhd", MakeMetaHeader("3 4 3", "LIST 2D") + "s.raw\ns.raw\ns.raw\n");
  EXPECT_EQ(ReadAll(folder / "a.mhd"), AsVoxels(CountUp(0, 12) + CountUp(0, 12) + CountUp(0, 12)));
}

TEST(MetaLayouts, PatternOfFiles)
{
  const TestFolder folder;
  folder.WriteFile("a.mhd", MakeMetaHeader("3 4 3", "s%03d.raw 8 12 2"));
  for (int z = 0; z < 3; ++z)
  {
    folder.WriteFile(z == 0 ? "s008.raw" : "s01" + std::to_string(2 * z - 2) + ".raw", CountUp(12 * z, 12));
  }
  EXPECT_EQ(ReadAll(folder / "a.mhd"), AsVoxels(CountUp(0, 36)));
  for (const char * const pattern : { "s%s.raw 1 3 1",
                                      "s%n.raw 1 3 1",
                                      "s%d%d.raw 1 3 1",
                                      "s%.raw 1 3 1",
                                      "s%9999d.raw 1 3 1",
                                      "s%d.raw 1 3 0",
                                      "s%d.raw 1 4 1",
                                      "s%d.raw -9223372036854775808 9223372036854775807 1" })
  {
    folder.WriteFile("a.mhd", MakeMetaHeader("3 4 3", pattern));
    EXPECT_NE(GetError([&] { Open(folder / "a.mhd"); }), "") << pattern;
  }
}

TEST(MetaLayouts, HeaderOfTheDataFile)
{
  const TestFolder folder;
  folder.WriteFile("d.raw", "twelve bytes" + CountUp(0, 60));
  for (const char * const skip : { "HeaderSize = 12\n", "HeaderSize = -1\n" })
  {
    folder.WriteFile("a.mhd", MakeMetaHeader("3 4 5", "d.raw", skip));
    EXPECT_EQ(ReadAll(folder / "a.mhd"), AsVoxels(CountUp(0, 60)));
  }
  folder.WriteFile("a.mhd", MakeMetaHeader("3 4 5", "d.raw", "HeaderSize = 11\n"));
  EXPECT_NE(GetError([&] { Open(folder / "a.mhd"); }).find("holds 121 bytes"), std::string::npos);
}

TEST(MetaLayouts, NegativeSpacingTurnsTheAxis)
{
  const TestFolder folder;
  folder.WriteFile("a.mha", MakeMetaHeader("3 4 5", "LOCAL", "ElementSpacing = 1 -2 3\n") + CountUp(0, 60));
  const auto reader = Open(folder / "a.mha");
  EXPECT_EQ(reader->GetDescription().Grid.Spacing, (std::vector<double>{ 1, 2, 3 }));
  EXPECT_EQ(reader->GetDescription().Grid.Directions[1], (std::vector<double>{ 0, -1, 0 }));
}

TEST(NrrdLayouts, DetachedDataWithLinesAndBytesToSkip)
{
  const TestFolder folder;
  folder.WriteFile("d.raw", "one line\nanother\nxyz" + CountUp(0, 60));
  folder.WriteFile("a.nhdr", MakeNrrdHeader("3 4 5", "endian: little\nline skip: 2\nbyteskip: 3\ndata file: d.raw\n"));
  EXPECT_EQ(ReadAll(folder / "a.nhdr"), AsVoxels(CountUp(0, 60)));
  folder.WriteFile("a.nhdr", MakeNrrdHeader("3 4 5", "endian: little\nbyte skip: -1\ndatafile: d.raw\n\n"));
  EXPECT_EQ(ReadAll(folder / "a.nhdr"), AsVoxels(CountUp(0, 60)));
  folder.WriteFile("a.nhdr", MakeNrrdHeader("3 4 5", "endian: little\nline skip: 9\ndata file: d.raw\n"));
  EXPECT_NE(GetError([&] { Open(folder / "a.nhdr"); }).find("truncated"), std::string::npos);
}

TEST(NrrdLayouts, ListsAndPatternsOfFiles)
{
  const TestFolder folder;
  folder.WriteFile("s1.raw", CountUp(0, 24, true));
  folder.WriteFile("s2.raw", CountUp(24, 24, true));
  const std::string start = MakeNrrdHeader("3 4 4", "endian: big\n");
  for (const char * const files : { "data file: LIST\ns1.raw\ns2.raw\n", "data file: s%d.raw 1 2 1\n\n" })
  {
    folder.WriteFile("a.nhdr", start + files);
    EXPECT_EQ(ReadAll(folder / "a.nhdr"), AsVoxels(CountUp(0, 48)));
  }
  folder.WriteFile("a.nhdr", start + "data file: LIST\ns1.raw\ns3.raw\n");
  EXPECT_NE(GetError([&] { Open(folder / "a.nhdr"); }).find("s3.raw: No such file"), std::string::npos);
  folder.WriteFile("a.nhdr", start + "data file: LIST\ns1.raw\ns2.raw\ns2.raw\ns2.raw\ns2.raw\n");
  EXPECT_NE(GetError([&] { Open(folder / "a.nhdr"); }), "");
}

// Where the voxels lie is what ITK's reader finds, in every way a header may say it.
TEST(NrrdLayouts, GridsAreThoseOfItk)
{
  const TestFolder folder;
  for (const char * const axes :
       { "spacings: 0.5 2 3\n",
         "spacings: 0.5 2 3\naxis mins: -1 5 0\n",
         "spacings: 0.5 2 3\naxis mins: -1 5 0\ncenters: node node node\n",
         "spacings: 0.5 2 3\naxis mins: -1 5 0\ncentering: cell cell cell\n",
         "space: left-posterior-superior\nspace directions: (0,2,0) (-3,0,0) (0,0,1.5)\nspace origin: (1,2,3)\n",
         "space: RAS\nspace directions: (0.6,0.8,0) (-1.6,1.2,0) (0,0,-1)\nspace origin: (1,2,3)\n",
         "space: right-anterior-superior\nkinds: domain domain domain\nspace directions: (1,0,0) (0,2,0) (0,0,3)\n",
         "space: scanner-xyz\nspace directions: (1, 0, 0) (0, 2, 0) (0, 0, 3)\nspace origin: (1, 2, 3)\n",
         "space dimension: 3\nspace directions: (1,0,0) (0,2,0) (0,0,3)\nspace origin: (1,2,3)\n" })
  {
    SCOPED_TRACE(axes);
    const std::string name = folder / "a.nrrd";
    folder.WriteFile("a.nrrd", MakeNrrdHeader("3 4 5", std::string("endian: little\n") + axes + "\n") + CountUp(0, 60));
    if (std::string(axes).find("centering:") != std::string::npos)
    {
      EXPECT_NE(GetError([&] { Open(name); }), ""); // not NRRD's name for it
      continue;
    }
    const auto      own = Open(name);
    const ItkReader itkReader(name);
    const auto &    meant = itkReader.GetDescription().Grid;
    const auto &    found = own->GetDescription().Grid;
    EXPECT_TRUE(own->ReadsParts());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(found.Spacing[axis], meant.Spacing[axis], 1e-12);
      EXPECT_NEAR(found.Origin[axis], meant.Origin[axis], 1e-12);
      for (std::size_t i = 0; i < 3; ++i)
      {
        EXPECT_NEAR(found.Directions[axis][i], meant.Directions[axis][i], 1e-12);
      }
    }
  }
}

// Left and superior stay, anterior becomes posterior (ITK 5.2 turns left instead).
TEST(NrrdLayouts, LeftAnteriorSuperior)
{
  const TestFolder folder;
  folder.WriteFile("a.nrrd",
                   MakeNrrdHeader("3 4 5",
                                  "endian: little\nspace: left-anterior-superior\n"
                                  "space directions: (1,0,0) (0,2,0) (0,0,3)\nspace origin: (1,2,3)\n\n") +
                     CountUp(0, 60));
  const auto   reader = Open(folder / "a.nrrd");
  const auto & grid = reader->GetDescription().Grid;
  EXPECT_EQ(grid.Origin, (std::vector<double>{ 1, -2, 3 }));
  EXPECT_EQ(grid.Directions, (std::vector<std::vector<double>>{ { 1, 0, 0 }, { 0, -1, 0 }, { 0, 0, 1 } }));
}

// The components of vectors and tensors are turned with the space that they refer to.
TEST(NrrdLayouts, TheFrameOfComponentsIsTurnedWithTheSpace)
{
  const TestFolder folder;
  const auto       getFrame = [&](const std::string & space, const std::string & frame) {
    folder.WriteFile("a.nrrd",
                     MakeNrrdHeader("3 4 5",
                                    "endian: little\nspace: " + space +
                                      "\nspace directions: (1,0,0) (0,2,0) (0,0,3)\nmeasurement frame: " + frame +
                                      "\n\n") +
                       CountUp(0, 60));
    const auto reader = Open(folder / "a.nrrd");
    WriteVolume(folder / "b.nrrd", reader->GetDescription(), ReadVoxels(*reader, GetWholeBox({ 3, 4, 5 })));
    const std::string field = "\nmeasurement frame: ";
    const std::string header = folder.ReadFile("b.nrrd");
    const auto        start = header.find(field);
    return start == std::string::npos
                   ? ""
                   : header.substr(start + field.size(), header.find('\n', start + 1) - start - field.size());
  };
  EXPECT_EQ(getFrame("left-posterior-superior", "(1,2,3) (4,5,6) (7,8,9)"), "(1,2,3) (4,5,6) (7,8,9)");
  EXPECT_EQ(getFrame("RAS", "(1,2,3) (4,5,6) ( 7, 8, 9 )"), "(-1,-2,3) (-4,-5,6) (-7,-8,9)");
  EXPECT_EQ(getFrame("LAS", "(1,2,3) (4,5,6) (7,-8,9)"), "(1,-2,3) (4,-5,6) (7,8,9)");
  EXPECT_EQ(getFrame("RAS", "none none none"), "");
}

// The same header, with the components as the first axis and as the last, says the same.
TEST(NrrdLayouts, ComponentsAsTheLastAxisKeepTheGridAndTheFrame)
{
  const TestFolder folder;
  const auto       open = [&](const std::string & space, const std::string & kind, bool isLast) {
    const std::string count = kind == "list" || kind == "vector" ? "3" : "6";
    const auto        order = [isLast](const std::string & own, const std::string & others) {
      return isLast ? others + ' ' + own : own + ' ' + others;
    };
    folder.WriteFile("a.nrrd",
                     MakeNrrdHeader(order(count, "3 4 5"),
                                    "endian: little\nspace: " + space + "\nkinds: " + order(kind, "space space space") +
                                      "\nspace directions: " + order("none", "(0.6,0.8,0) (-1.6,1.2,0) (0,0,3)") +
                                      "\nspace origin: (1,2,3)\nmeasurement frame: (1,2,3) (4,5,6) (7,8,9)\n" +
                                      "space units: \"um\" \"um\" \"um\"\nmodality:=DWMRI\n\n") +
                       CountUp(0, count == "3" ? 180 : 360));
    return Open(folder / "a.nrrd");
  };
  for (const char * const kind : { "list", "vector", "3D-symmetric-matrix" })
  {
    for (const auto & [space, x, y, frame] :
         { std::tuple("left-posterior-superior", 1.0, 1.0, "(1,2,3) (4,5,6) (7,8,9)"),
           std::tuple("right-anterior-superior", -1.0, -1.0, "(-1,-2,3) (-4,-5,6) (-7,-8,9)"),
           std::tuple("left-anterior-superior", 1.0, -1.0, "(1,-2,3) (4,-5,6) (7,-8,9)"),
           std::tuple("scanner-xyz", 1.0, 1.0, "(1,2,3) (4,5,6) (7,8,9)") })
    {
      SCOPED_TRACE(std::string(kind) + ' ' + space);
      const auto   first = open(space, kind, false);
      const auto   last = open(space, kind, true);
      const auto & grid = last->GetDescription().Grid;
      EXPECT_EQ(grid.Size, (std::vector<std::uint64_t>{ 3, 4, 5 }));
      EXPECT_EQ(grid.Origin, (std::vector<double>{ x, 2 * y, 3 }));
      ASSERT_EQ(grid.Directions.size(), 3u);
      for (std::size_t i = 0; i < 3; ++i)
      {
        EXPECT_NEAR(grid.Spacing[i], static_cast<double>(i + 1), 1e-12);
        EXPECT_NEAR(grid.Directions[0][i], (std::array{ 0.6 * x, 0.8 * y, 0.0 })[i], 1e-12);
        EXPECT_NEAR(grid.Directions[1][i], (std::array{ -0.8 * x, 0.6 * y, 0.0 })[i], 1e-12);
      }
      EXPECT_EQ(last->GetDescription().Kind, first->GetDescription().Kind);
      EXPECT_EQ(last->GetDescription().NumberOfComponents, first->GetDescription().NumberOfComponents);
      EXPECT_EQ(last->GetDescription().Metadata, first->GetDescription().Metadata);
      WriteVolume(folder / "b.nrrd", last->GetDescription(), ReadVoxels(*last, GetWholeBox({ 3, 4, 5 })));
      EXPECT_NE(folder.ReadFile("b.nrrd").find(std::string("\nmeasurement frame: ") + frame + '\n'), std::string::npos);
    }
  }
}

TEST(NrrdLayouts, AnAxisOfNoLengthIsRefusedWhereComponentsAreTheLastOne)
{
  const TestFolder folder;
  folder.WriteFile("a.nrrd",
                   MakeNrrdHeader("3 4 3",
                                  "endian: little\nspace dimension: 2\nkinds: space space vector\n"
                                  "space directions: (0,0) (0,1) none\n\n") +
                     CountUp(0, 36));
  EXPECT_NE(GetError([&] { DescribeNrrd(folder / "a.nrrd"); }).find("spacing of its axis 0"), std::string::npos);
}

// ITK turns the other coordinate up to version 5.2, and what the own reader does not understand is ITK's to describe.
TEST(NrrdLayouts, LeftAnteriorSuperiorIsRefusedWhereComponentsAreAmongTheAxes)
{
  const TestFolder folder;
  const auto       getError = [&folder](const std::string & space) {
    folder.WriteFile("a.nrrd",
                     MakeNrrdHeader("3 4 3 5",
                                    "endian: little\nkinds: space space vector space\nspace: " + space +
                                      "\nspace directions: (1,0,0) (0,2,0) none (0,0,3)\n\n") +
                       CountUp(0, 180));
    return GetError([&] { Open(folder / "a.nrrd"); });
  };
  EXPECT_EQ(getError("right-anterior-superior"), "");
  EXPECT_NE(getError("LAS").find("a.nrrd: with axes like its own, the space left-anterior"), std::string::npos);
}

// The space of a space with time, which stays the fourth coordinate.
TEST(NrrdLayouts, SpacesWithTime)
{
  const TestFolder folder;
  const auto       write = [&](const std::string & space) {
    folder.WriteFile("a.nrrd",
                     "NRRD0004\ntype: unsigned char\ndimension: 4\nsizes: 3 4 5 2\nencoding: raw\nspace: " + space +
                       "\nspace directions: (1,0,0,0) (0,2,0,0) (0,0,3,0) (0,0,0,7)\nspace origin: (1,2,3,4)\n\n" +
                       std::string(120, 'x'));
  };
  for (const auto & [space, x, y] : { std::tuple("LPST", 1.0, 1.0),
                                      std::tuple("left-posterior-superior-time", 1.0, 1.0),
                                      std::tuple("RAST", -1.0, -1.0),
                                      std::tuple("right-anterior-superior-time", -1.0, -1.0),
                                      std::tuple("LAST", 1.0, -1.0),
                                      std::tuple("scanner-xyz-time", 1.0, 1.0),
                                      std::tuple("3D-right-handed-time", 1.0, 1.0) })
  {
    SCOPED_TRACE(space);
    write(space);
    const auto   reader = Open(folder / "a.nrrd");
    const auto & grid = reader->GetDescription().Grid;
    EXPECT_EQ(grid.Size, (std::vector<std::uint64_t>{ 3, 4, 5, 2 }));
    EXPECT_EQ(grid.Spacing, (std::vector<double>{ 1, 2, 3, 7 }));
    EXPECT_EQ(grid.Origin, (std::vector<double>{ x, 2 * y, 3, 4 }));
    EXPECT_EQ(grid.Directions,
              (std::vector<std::vector<double>>{ { x, 0, 0, 0 }, { 0, y, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } }));
  }
  write("here-and-there");
  EXPECT_NE(GetError([&] { Open(folder / "a.nrrd"); }).find("a.nrrd: its space here-and-there"), std::string::npos);
}

TEST(NrrdLayouts, ComponentsComeFirstOrAreMovedThere)
{
  const TestFolder folder;
  const auto       write = [&](const std::string & sizes, const std::string & kinds) {
    folder.WriteFile("a.nrrd", MakeNrrdHeader(sizes, "endian: little\nkinds: " + kinds + "\n\n") + CountUp(0, 60));
    return Open(folder / "a.nrrd");
  };
  const auto rgb = write("3 4 5", "RGB-color domain domain");
  EXPECT_EQ(rgb->GetDescription().Grid.Size, (std::vector<std::uint64_t>{ 4, 5 }));
  EXPECT_EQ(rgb->GetDescription().NumberOfComponents, 3u);
  EXPECT_EQ(rgb->GetDescription().Kind, VoxelKind::Rgb);

  const auto tensors = write("6 2 5", "3D-symmetric-matrix domain domain");
  EXPECT_EQ(tensors->GetDescription().Grid.Size, (std::vector<std::uint64_t>{ 2, 5 }));
  EXPECT_EQ(tensors->GetDescription().NumberOfComponents, 6u);
  EXPECT_EQ(tensors->GetDescription().Kind, VoxelKind::SymmetricTensor);
  EXPECT_NE(GetError([&] { write("5 4 3", "3D-symmetric-matrix domain domain"); }).find("has the size 5"),
            std::string::npos);
  EXPECT_NE(GetError([&] { write("6 2 5", "3D-masked-symmetric-matrix domain domain"); }).find("mask"),
            std::string::npos);

  const auto last = write("4 5 3", "domain domain vector");
  EXPECT_EQ(last->GetDescription().Grid.Size, (std::vector<std::uint64_t>{ 4, 5 }));
  EXPECT_EQ(last->GetDescription().NumberOfComponents, 3u);
  std::string moved;
  for (int i = 0; i < 20; ++i)
  {
    moved += CountUp(i, 1) + CountUp(20 + i, 1) + CountUp(40 + i, 1);
  }
  EXPECT_EQ(ReadVoxels(*last, GetWholeBox({ 4, 5 })), AsVoxels(moved));
  EXPECT_NE(GetError([&] { write("4 5 3", "RGB-color domain domain"); }), "");
}
