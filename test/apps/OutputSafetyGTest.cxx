// SPDX-License-Identifier: Apache-2.0
// Nothing but the output is ever touched, and the output is whole or not there.
#include "TestFolder.h"
#include "VolumeTestImages.h"

#include <gtest/gtest.h>

#include <unistd.h>

using namespace VolumeTest;
using itk::Subdivision::ElementType;
namespace fs = std::filesystem;

namespace
{
const ImageDescription Description = MakeDescription({ 8, 6, 5 }, ElementType::UInt16);
const auto             Voxels = MakeVoxels(Description);

class OutputSafety : public testing::TestWithParam<const char *>
{
protected:
  std::string
  GetPath() const
  {
    return m_Folder / m_Name;
  }

  TestFolder  m_Folder;
  std::string m_Name = std::string("scan") + GetParam();
};
} // namespace

TEST_P(OutputSafety, FilesOfAllNamesStay)
{
  for (const char * const decoy : { "scan",
                                    "scan.txt",
                                    "image.nii",
                                    "probe",
                                    ".partial-aaaaaa",
                                    "scan.raw.bak",
                                    ".scan.partial-aaaaaa",
                                    "other.raw" })
  {
    m_Folder.WriteFile(decoy, decoy);
  }
  auto       before = m_Folder.GetFiles();
  const auto current = fs::current_path();
  fs::current_path(m_Folder / "");
  fs::create_directory("elsewhere");
  WriteVolume("elsewhere/" + m_Name, Description, Voxels);
  fs::current_path(current);
  before["elsewhere"] = "";
  EXPECT_TRUE(m_Folder.GetFiles() == before);
  EXPECT_EQ(ReadAll(m_Folder / ("elsewhere/" + m_Name)), Voxels);
}

TEST_P(OutputSafety, WithoutCommitNothingStays)
{
  m_Folder.WriteFile(m_Name, "old");
  const auto before = m_Folder.GetFiles();
  {
    const auto writer = CreateVolume(this->GetPath(), {}, [](const std::string &) {});
    writer->Begin(Description);
    writer->Write(GetWholeBox(Description.Grid.Size), Voxels.data());
  }
  EXPECT_TRUE(m_Folder.GetFiles() == before);
}

TEST_P(OutputSafety, AnOutputIsReplacedAgainAndAgain)
{
  for (int i = 0; i < 2; ++i)
  {
    WriteVolume(this->GetPath(), Description, Voxels);
    EXPECT_EQ(ReadAll(this->GetPath()), Voxels);
  }
}

TEST_P(OutputSafety, TheOutputMayBeTheInput)
{
  WriteVolume(this->GetPath(), Description, Voxels);
  const auto reader = Open(this->GetPath());
  const auto files = m_Folder.GetFiles();
  const auto writer = CreateVolume(this->GetPath(), {}, [](const std::string &) {});
  writer->Begin(reader->GetDescription());
  writer->Write(GetWholeBox(Description.Grid.Size), ReadVoxels(*reader, GetWholeBox(Description.Grid.Size)).data());
  writer->Commit();
  EXPECT_EQ(ReadAll(this->GetPath()), Voxels);
  EXPECT_EQ(m_Folder.GetFiles().size(), files.size());
}

TEST_P(OutputSafety, ALinkStaysOne)
{
  fs::create_directory(m_Folder / "there");
  fs::create_symlink("there/" + m_Name, this->GetPath()); // to nothing as yet
  for (int i = 0; i < 2; ++i)
  {
    WriteVolume(this->GetPath(), Description, Voxels);
    EXPECT_TRUE(fs::is_symlink(this->GetPath()));
    EXPECT_EQ(ReadAll(m_Folder / ("there/" + m_Name)), Voxels);
  }
}

TEST_P(OutputSafety, PermissionsOfAReplacedFileStay)
{
  WriteVolume(this->GetPath(), Description, Voxels);
  fs::permissions(this->GetPath(), fs::perms(0640));
  WriteVolume(this->GetPath(), Description, Voxels);
  EXPECT_EQ(fs::status(this->GetPath()).permissions(), fs::perms(0640));
}

TEST_P(OutputSafety, WhatIsNoFileIsNotReplaced)
{
  fs::create_directory(this->GetPath());
  EXPECT_NE(GetError([&] { WriteVolume(this->GetPath(), Description, Voxels); }), "");
  fs::remove(this->GetPath());
  fs::create_symlink("/dev/null", this->GetPath());
  EXPECT_NE(GetError([&] { WriteVolume(this->GetPath(), Description, Voxels); }).find("not a regular file"),
            std::string::npos);
}

TEST_P(OutputSafety, NamesMayBeAsLongAsTheFileSystemAllows)
{
  const std::string ending = GetParam();
  const std::string path = m_Folder / (std::string(255 - ending.size(), 'n') + ending);
  WriteVolume(path, Description, Voxels);
  EXPECT_EQ(ReadAll(path), Voxels);
}

TEST_P(OutputSafety, OddNamesAreNoPatternsAndLists)
{
  for (const char * const stem : { "LIST of scans", "LOCAL", "50%d 1 2", " 1 2 3 4", "a=b:c", "\xc3\xa4" })
  {
    const std::string path = m_Folder / (std::string(stem) + GetParam());
    WriteVolume(path, Description, Voxels);
    EXPECT_EQ(ReadAll(path), Voxels) << stem;
  }
}

TEST_P(OutputSafety, AMissingPartIsNoticed)
{
  const auto writer = CreateVolume(this->GetPath(), {}, [](const std::string &) {});
  writer->Begin(Description);
  if (writer->WritesParts())
  {
    writer->Write({ { 0, 8 }, { 0, 6 }, { 0, 4 } }, Voxels.data());
    EXPECT_NE(GetError([&] { writer->Commit(); }).find("not all voxels"), std::string::npos);
  }
}

// Root may write anywhere, so the folder's permissions say nothing to it.
TEST_P(OutputSafety, AFileInAReadOnlyFolderIsWrittenInPlace)
{
  if (geteuid() == 0)
  {
    GTEST_SKIP() << "root may write to every folder";
  }
  WriteVolume(this->GetPath(), Description, Voxels);
  fs::permissions(m_Folder / "", fs::perms(0555));
  auto                     other = Voxels;
  std::vector<std::string> warnings;
  other.front() = 7;
  WriteVolume(this->GetPath(), Description, other, {}, [&](const std::string & text) { warnings.push_back(text); });
  fs::permissions(m_Folder / "", fs::perms(0755));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("in place"), std::string::npos);
  EXPECT_EQ(ReadAll(this->GetPath()), other);
}

INSTANTIATE_TEST_SUITE_P(Formats, OutputSafety, testing::Values(".mha", ".mhd", ".nrrd", ".nhdr", ".nii", ".nii.gz"));

class DetachedData : public testing::TestWithParam<const char *>
{};

TEST_P(DetachedData, OfAnotherImageAreNotReplaced)
{
  const TestFolder  folder;
  const std::string path = folder / (std::string("scan") + GetParam());
  folder.WriteFile("scan.raw", "another image's voxels");
  const auto before = folder.GetFiles();
  EXPECT_NE(GetError([&] { WriteVolume(path, Description, Voxels); }).find("scan.raw"), std::string::npos);
  EXPECT_TRUE(folder.GetFiles() == before);

  // Not even if there is a header of the output's name, but for other data.
  folder.WriteFile(std::string("scan") + GetParam(), "ElementDataFile = other.raw\ndata file: other.raw\n");
  EXPECT_NE(GetError([&] { WriteVolume(path, Description, Voxels); }).find("scan.raw"), std::string::npos);
  EXPECT_EQ(folder.ReadFile("scan.raw"), "another image's voxels");
}

TEST_P(DetachedData, ThatAppearMeanwhileAreNotReplaced)
{
  const TestFolder  folder;
  const std::string path = folder / (std::string("scan") + GetParam());
  const auto        writer = CreateVolume(path, {}, [](const std::string &) {});
  writer->Begin(Description);
  writer->Write(GetWholeBox(Description.Grid.Size), Voxels.data());
  folder.WriteFile("scan.raw", "another image's voxels");
  EXPECT_NE(GetError([&] { writer->Commit(); }).find("scan.raw"), std::string::npos);
  EXPECT_EQ(folder.ReadFile("scan.raw"), "another image's voxels");
}

INSTANTIATE_TEST_SUITE_P(Formats, DetachedData, testing::Values(".mhd", ".nhdr"));
