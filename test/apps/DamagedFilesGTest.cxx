// SPDX-License-Identifier: Apache-2.0
// A file that is damaged ends in an error, or its voxels are those that it says: never others.
#include "TestFolder.h"
#include "VolumeTestImages.h"

#include <gtest/gtest.h>

#include <random>
#include <sys/stat.h>

using namespace VolumeTest;
using itk::Subdivision::ElementType;

namespace
{
class DamagedFiles : public testing::TestWithParam<std::tuple<std::string, bool>>
{
protected:
  DamagedFiles()
  {
    OutputOptions options;
    options.Compress = std::get<1>(GetParam());
    WriteVolume(this->GetPath(), m_Description, m_Voxels, options);
    m_Files = m_Folder.GetFiles();
  }

  std::string
  GetPath() const
  {
    return m_Folder / m_Name;
  }

  /** Whether the file is read to its end. */
  bool
  IsRead() const
  {
    return GetError([this] { ReadAll(this->GetPath()); }).empty();
  }

  TestFolder                         m_Folder;
  std::string                        m_Name = "image" + std::get<0>(GetParam());
  ImageDescription                   m_Description = MakeDescription({ 9, 7, 5 }, ElementType::Int16);
  std::vector<char>                  m_Voxels = MakeVoxels(m_Description);
  std::map<std::string, std::string> m_Files;
};
} // namespace

TEST_P(DamagedFiles, AnyTruncationIsNoticed)
{
  ASSERT_TRUE(this->IsRead());
  for (const auto & [name, content] : m_Files)
  {
    const bool isDetachedHeader = m_Files.size() > 1 && name == m_Name;
    for (std::size_t size = 0; size + (isDetachedHeader ? 3 : 0) < content.size(); ++size)
    {
      m_Folder.WriteFile(name, content.substr(0, size));
      ASSERT_FALSE(this->IsRead()) << name << " cut to " << size << " of " << content.size() << " bytes";
    }
    m_Folder.WriteFile(name, content);
  }
}

TEST_P(DamagedFiles, MoreThanTheHeaderSaysIsNoticed)
{
  for (const auto & [name, content] : m_Files)
  {
    const bool isCompressed = std::get<1>(GetParam());
    if (name != m_Name || m_Files.size() == 1)
    {
      m_Folder.WriteFile(name, content + std::string(18, '\0'));
      EXPECT_TRUE(isCompressed || !this->IsRead());
      m_Folder.WriteFile(name, content);
    }
  }
}

// Fields that are left out, doubled, or have another number must not make other voxels of the bytes.
TEST_P(DamagedFiles, HeadersThatSayOtherSizesAreNoticed)
{
  const std::string header = m_Files[m_Name];
  for (const char * const wrong : { "9 7 4",
                                    "9 7 6",
                                    "9 7 -5",
                                    "9 7 0",
                                    "9 7",
                                    "9 7 5 1",
                                    "9 7 5x",
                                    "9 7 1e1",
                                    "9 7 nan",
                                    "9 7 99999999999999999999",
                                    "9 4294967296 4294967296",
                                    "9223372036854775807 2 2" })
  {
    std::string damaged = header;
    damaged.replace(damaged.find("9 7 5"), 5, wrong);
    m_Folder.WriteFile(m_Name, damaged);
    EXPECT_FALSE(this->IsRead()) << wrong;
  }
}

TEST_P(DamagedFiles, ALineLessOrTwiceIsNoticedOrMakesNoDifference)
{
  const std::string header = m_Files[m_Name];
  const std::size_t end = m_Files.size() > 1                            ? header.size()
                          : header.find("LOCAL\n") != std::string::npos ? header.find("LOCAL\n") + 6
                                                                        : header.find("\n\n") + 1;
  for (std::size_t start = 0; start < end;)
  {
    const std::size_t next = header.find('\n', start) + 1;
    const std::string line = header.substr(start, next - start);
    for (const std::string & changed : { std::string(), line + line })
    {
      m_Folder.WriteFile(m_Name, header.substr(0, start) + changed + header.substr(next));
      std::vector<char> voxels;
      const std::string error = GetError([&] { voxels = ReadAll(this->GetPath()); });
      EXPECT_TRUE(!error.empty() || voxels == m_Voxels) << line;
      // Nothing but a name is without meaning if doubled.
      EXPECT_TRUE(changed.empty() || !error.empty() || line[0] == '#' || line == "\n" ||
                  (m_Files.size() > 1 && line.rfind("ElementDataFile", 0) == 0)) // what follows is no header
        << line;
    }
    start = next;
  }
}

// Random changes of bytes: no crash, no endless loop, no memory beyond what the file can hold, no other voxels than
// those that stand in the file.
TEST_P(DamagedFiles, RandomChangesOfTheHeader)
{
  const std::string header = m_Files[m_Name];
  const std::size_t end = std::min<std::size_t>(header.size(), 480);
  std::mt19937      random(3);
  int               numberRead = 0;
  for (int i = 0; i < 500; ++i)
  {
    std::string damaged = header;
    for (int k = 0; k <= i % 3; ++k)
    {
      const std::size_t place = random() % end;
      const char        values[] = "0123456789-.= :\n\0LIST%d()xe";
      const char        value = values[random() % (sizeof(values) - 1)];
      if (random() % 3 == 0)
      {
        damaged.insert(place, 1, value);
      }
      else
      {
        damaged[place] = value;
      }
    }
    m_Folder.WriteFile(m_Name, damaged);
    std::vector<char> voxels;
    if (GetError([&] { voxels = ReadAll(this->GetPath()); }).empty())
    {
      ++numberRead;
      EXPECT_EQ(voxels.size(), m_Voxels.size()) << damaged.substr(0, end);
    }
  }
  EXPECT_LT(numberRead, 400);
}

INSTANTIATE_TEST_SUITE_P(Formats,
                         DamagedFiles,
                         testing::Combine(testing::Values(".mha", ".mhd", ".nrrd", ".nhdr"), testing::Bool()));

TEST(SpecialFiles, AreRefusedAtOnce)
{
  const TestFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe.mha").c_str(), 0600), 0);
  EXPECT_NE(GetError([&] { Open(folder / "pipe.mha"); }).find("it is a named pipe"), std::string::npos);
  EXPECT_NE(GetError([&] { Open("/dev/zero"); }).find("it is a device"), std::string::npos);
  EXPECT_NE(GetError([&] { Open(folder / "missing.nrrd"); }).find("No such file"), std::string::npos);
}

// What lies about the size of a huge image must not take the memory for it.
TEST(SpecialFiles, HugeSizesTakeNoMemory)
{
  const TestFolder folder;
  folder.WriteFile("a.mha",
                   "NDims = 3\nDimSize = 100000 100000 100000\nCompressedData = True\nElementType = MET_UCHAR\n"
                   "ElementDataFile = LOCAL\n\x78\x9c");
  const auto reader = Open(folder / "a.mha");
  char       voxel = 0;
  EXPECT_NE(GetError([&] { reader->Read({ { 0, 1 }, { 0, 1 }, { 99999, 1 } }, &voxel); }).find("truncated"),
            std::string::npos);
}
