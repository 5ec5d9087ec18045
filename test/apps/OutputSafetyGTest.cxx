// SPDX-License-Identifier: Apache-2.0
// Nothing but the output is ever touched, and the output is whole or not there.
#include "TestFolder.h"
#include "VolumeTestImages.h"
#include "formats/CreateVolume.h"

#include <gtest/gtest.h>

#include <stdexcept>

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

TEST_P(OutputSafety, ALinkToItselfIsNoOutput)
{
  fs::create_symlink(m_Name, this->GetPath());
  EXPECT_NE(GetError([&] { WriteVolume(this->GetPath(), Description, Voxels); }).find("symbolic links"),
            std::string::npos);
  EXPECT_TRUE(fs::is_symlink(this->GetPath()));
}

TEST_P(OutputSafety, ALinkToTheInputIsWrittenThrough)
{
  WriteVolume(m_Folder / ("input" + std::string(GetParam())), Description, Voxels);
  fs::create_directory(m_Folder / "links");
  const std::string link = m_Folder / ("links/" + m_Name);
  fs::create_symlink("../input" + std::string(GetParam()), link);
  const auto reader = Open(m_Folder / ("input" + std::string(GetParam())));
  auto       other = ReadVoxels(*reader, GetWholeBox(Description.Grid.Size));
  other.front() = 7;
  WriteVolume(link, Description, other);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(ReadAll(m_Folder / ("input" + std::string(GetParam()))), other);
  EXPECT_EQ(fs::directory_iterator(m_Folder / "links")->path(), link);
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

namespace
{
/** Root may write anywhere: the tests of permissions are another user's while this lives. */
class UnprivilegedUser
{
public:
  UnprivilegedUser() { this->Become(Nobody); }
  ~UnprivilegedUser() { this->Become(0); }
  UnprivilegedUser(const UnprivilegedUser &) = delete;
  UnprivilegedUser &
  operator=(const UnprivilegedUser &) = delete;

private:
  void
  Become(const uid_t user) const
  {
    if (getuid() == 0 && seteuid(user) != 0)
    {
      throw std::runtime_error("the user cannot be changed");
    }
  }

  static constexpr uid_t Nobody = 65534;
};
} // namespace

TEST_P(OutputSafety, AFileInAReadOnlyFolderIsWrittenInPlace)
{
  WriteVolume(this->GetPath(), Description, Voxels);
  for (const auto & file : m_Folder.GetFiles())
  {
    fs::permissions(m_Folder / file.first, fs::perms(0666));
  }
  fs::permissions(m_Folder / "", fs::perms(0555));
  auto                     other = Voxels;
  std::vector<std::string> warnings;
  other.front() = 7;
  {
    const UnprivilegedUser user;
    WriteVolume(this->GetPath(), Description, other, {}, [&](const std::string & text) { warnings.push_back(text); });
  }
  fs::permissions(m_Folder / "", fs::perms(0755));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("in place"), std::string::npos);
  EXPECT_EQ(ReadAll(this->GetPath()), other);
}

TEST_P(OutputSafety, AnothersFileThatMayNotBeRenamedIsWrittenInPlace)
{
  if (getuid() != 0)
  {
    GTEST_SKIP() << "only root has files of two users";
  }
  WriteVolume(this->GetPath(), Description, Voxels);
  for (const auto & file : m_Folder.GetFiles())
  {
    fs::permissions(m_Folder / file.first, fs::perms(0666));
  }
  fs::permissions(m_Folder / "", fs::perms(01777));
  auto other = Voxels;
  other.front() = 7;
  {
    const UnprivilegedUser user;
    WriteVolume(this->GetPath(), Description, other);
  }
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

TEST_P(DetachedData, OfTwoHeadersAreNotReplaced)
{
  const TestFolder  folder;
  const std::string path = folder / (std::string("scan7") + GetParam());
  WriteVolume(path, Description, Voxels);
  for (const char * const owner : { "ElementDataFile = scan7.raw\n",
                                    "ElementDataFile = ./scan7.raw\r\n",
                                    "data file: scan7.raw\n",
                                    "ElementDataFile = LIST\nother.raw\nscan7.raw\n",
                                    "data file: scan%01d.raw 1 9 1\n",
                                    "data file: other%d.raw 1 9 1\n",
                                    "data file: elsewhere/scan7.raw\n" })
  {
    const bool isOwner = std::string(owner).find("other%") == std::string::npos &&
                         std::string(owner).find("elsewhere") == std::string::npos;
    folder.WriteFile("second.nhdr", owner);
    auto other = Voxels;
    other.front() = 7;
    const auto before = folder.GetFiles();
    const auto error = GetError([&] { WriteVolume(path, Description, other); });
    EXPECT_EQ(error.find("second.nhdr") != std::string::npos, isOwner) << owner << error;
    EXPECT_TRUE(!isOwner || folder.GetFiles() == before) << owner;
  }
  // A link to the header is the header.
  fs::create_symlink(path, folder / "link.mhd");
  WriteVolume(path, Description, Voxels);
  EXPECT_EQ(ReadAll(path), Voxels);
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

/** As where a file system of another machine tells at the end that it could not write. */
TEST_P(DetachedData, ThatCannotBeClosedAreNoOutput)
{
  const TestFolder  folder;
  const std::string path = folder / (std::string("scan") + GetParam());
  const auto        writer = CreateVolume(path, {}, [](const std::string &) {});
  writer->Begin(Description);
  writer->Write(GetWholeBox(Description.Grid.Size), Voxels.data());
  int closed = 0;
  for (int descriptor = 0; descriptor < 1024; ++descriptor)
  {
    std::error_code error;
    if (fs::read_symlink("/proc/self/fd/" + std::to_string(descriptor), error).filename() == "scan.raw")
    {
      close(descriptor);
      ++closed;
    }
  }
  ASSERT_EQ(closed, 1);
  EXPECT_NE(GetError([&] { writer->Commit(); }).find("cannot write " + path), std::string::npos);
  EXPECT_FALSE(fs::exists(path));
}

INSTANTIATE_TEST_SUITE_P(Formats, DetachedData, testing::Values(".mhd", ".nhdr"));
