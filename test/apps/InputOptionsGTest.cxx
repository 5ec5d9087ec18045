// SPDX-License-Identifier: Apache-2.0
// Options that choose a part of an input: each kind of input takes its own, and refuses the others.
#include "TestFolder.h"
#include "TiffTestFile.h"
#include "VolumeTestImages.h"
#include "plain/RawReader.h"

#include <gtest/gtest.h>

using namespace VolumeTest;
using itk::Subdivision::ElementType;

namespace
{
class InputOptionsTest : public testing::Test
{
protected:
  enum Choice
  {
    Series,
    Channel,
    Frame
  };

  /** What an input is refused with, where the first of its parts is chosen. */
  std::string
  GetErrorOf(const std::string & name, Choice choice, InputOptions options = {}) const
  {
    if (choice == Series)
    {
      options.Series = "1";
    }
    else
    {
      (choice == Channel ? options.Channel : options.Frame) = 0;
    }
    return GetError([&] { OpenVolume(m_Folder / name, options, [](const std::string &) {}); });
  }

  void
  ExpectRefused(const std::string & name, const std::vector<Choice> & choices, const InputOptions & options = {}) const
  {
    for (const Choice choice : choices)
    {
      const std::string option = choice == Series ? "--series" : choice == Channel ? "--channel" : "--frame";
      const std::string start = "cannot read " + (m_Folder / name) + ": " + option + " chooses among ";
      const std::string error = GetErrorOf(name, choice, options);
      EXPECT_EQ(error.substr(0, start.size()), start);
    }
  }

  void
  WriteTiff(const std::string & name, int pages) const
  {
    TiffTestFile file;
    TiffTestPage page;
    page.Width = 4;
    page.Height = 3;
    for (; pages > 0; --pages)
    {
      file.AddPage(page, std::vector<std::uint8_t>(12, 7));
    }
    m_Folder.WriteFile(name, file.GetBytes());
  }

  const TestFolder m_Folder;
};
} // namespace

TEST_F(InputOptionsTest, FilesOfOneVolumeOfferNone)
{
  const ImageDescription scalars = MakeDescription({ 5, 4, 3 }, ElementType::UInt8);
  const ImageDescription vectors = MakeDescription({ 5, 4, 3 }, ElementType::UInt8, 3);
  for (const std::string name : { "a.mha", "a.nrrd", "a.nii", "a.vtk" })
  {
    WriteVolume(m_Folder / name, scalars, MakeVoxels(scalars));
    ExpectRefused(name, { Series, Channel, Frame });
    WriteVolume(m_Folder / name, vectors, MakeVoxels(vectors));
    ExpectRefused(name, { Series, Channel, Frame });
  }
}

TEST_F(InputOptionsTest, RawFilesOfferNone)
{
  m_Folder.WriteFile("a.raw", std::string(60, 'a'));
  for (const char * const layout : { "5x4x3:uint8", "5x2x2:uint8:3", "5x2x2x3:uint8" })
  {
    InputOptions options;
    options.Raw = ParseRawLayout(layout);
    EXPECT_EQ(GetError([&] { OpenVolume(m_Folder / "a.raw", options, [](const std::string &) {}); }), "");
    ExpectRefused("a.raw", { Series, Channel, Frame }, options);
  }
}

TEST_F(InputOptionsTest, FoldersOfSlicesOfferNone)
{
  std::filesystem::create_directory(m_Folder / "slices");
  for (const char * const name : { "slices/a0.tif", "slices/a1.tif" })
  {
    WriteTiff(name, 1);
  }
  EXPECT_EQ(GetError([&] { Open(m_Folder / "slices"); }), "");
  ExpectRefused("slices", { Series, Channel, Frame });
}

TEST_F(InputOptionsTest, TiffFilesOfferChannelsAndFrames)
{
  WriteTiff("a.tif", 2);
  ExpectRefused("a.tif", { Series });
  EXPECT_EQ(GetErrorOf("a.tif", Channel), "");
  EXPECT_EQ(GetErrorOf("a.tif", Frame), "");
}
