// SPDX-License-Identifier: Apache-2.0
#ifndef DicomTest_h
#define DicomTest_h

#include "DicomTestData.h"
#include "dicom/Dicom.h"

#include "gdcmImageChangeTransferSyntax.h"
#include "gdcmImageReader.h"
#include "gdcmImageWriter.h"
#include "gtest/gtest.h"

#include <cstdlib>
#include <random>

/** Series of slices of 4 x 3 voxels in a folder of its own. */
class DicomTest : public testing::Test
{
protected:
  static constexpr unsigned int Columns = 4;
  static constexpr unsigned int Rows = 3;

  void
  SetUp() override
  {
    std::string pattern = testing::TempDir() + "dicom-XXXXXX";
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    m_Folder = pattern;
  }

  void
  TearDown() override
  {
    std::filesystem::remove_all(m_Folder);
  }

  static std::vector<std::int16_t>
  MakeValues(unsigned int seed, int low = -1000, int high = 3000)
  {
    std::mt19937                       source(seed);
    std::uniform_int_distribution<int> number(low, high);
    std::vector<std::int16_t>          values(Columns * Rows);
    for (std::int16_t & value : values)
    {
      value = static_cast<std::int16_t>(number(source));
    }
    return values;
  }

  static DicomTestData
  MakeSlice(int number, double z, const std::string & series = "1.2.3.4")
  {
    return DicomTestData(series, number, z, Columns, Rows, MakeValues(static_cast<unsigned int>(number)));
  }

  void
  WriteSlices(int count, double spacing)
  {
    for (int i = 0; i < count; ++i)
    {
      MakeSlice(i, i * spacing).Write(m_Folder / std::to_string(i));
    }
  }

  /** Encodes the pixels of a file in another way. */
  void
  Encode(const std::string & name, const gdcm::TransferSyntax & syntax)
  {
    const std::string path = (m_Folder / name).string();
    gdcm::ImageReader reader;
    reader.SetFileName(path.c_str());
    ASSERT_TRUE(reader.Read());
    gdcm::ImageChangeTransferSyntax change;
    change.SetTransferSyntax(syntax);
    change.SetInput(reader.GetImage());
    ASSERT_TRUE(change.Change());
    gdcm::ImageWriter writer;
    writer.SetFileName(path.c_str());
    writer.SetFile(reader.GetFile());
    writer.SetImage(change.GetOutput());
    ASSERT_TRUE(writer.Write());
  }

  std::unique_ptr<VolumeReader>
  Open(const InputOptions & options = {}, const std::string & name = "")
  {
    m_Warnings.clear();
    return OpenDicom(
      (m_Folder / name).string(), options, [this](const std::string & text) { m_Warnings.push_back(text); });
  }

  /** What the user is told where a series is refused. */
  std::string
  GetRefusal(const InputOptions & options = {}, const std::string & name = "")
  {
    try
    {
      const auto reader = Open(options, name);
      Read<char>(*reader);
    }
    catch (const std::runtime_error & error)
    {
      return error.what();
    }
    return "";
  }

  template <typename T>
  static std::vector<T>
  Read(VolumeReader & reader, itk::Subdivision::Box box = {})
  {
    const ImageDescription & description = reader.GetDescription();
    std::uint64_t            bytes = description.GetVoxelBytes();
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (box.size() == axis)
      {
        box.push_back({ 0, description.Grid.Size[axis] });
      }
      bytes *= box[axis].Size;
    }
    std::vector<T> values(bytes / sizeof(T));
    reader.Read(box, values.data());
    return values;
  }

  /** The values of slices that MakeSlice() made, one after the other. */
  template <typename T = std::int16_t>
  static std::vector<T>
  Expect(const std::vector<unsigned int> & numbers)
  {
    std::vector<T> all;
    for (const unsigned int number : numbers)
    {
      const auto values = MakeValues(number);
      all.insert(all.end(), values.begin(), values.end());
    }
    return all;
  }

  std::filesystem::path    m_Folder;
  std::vector<std::string> m_Warnings;
};

/** Whether a text holds all words; the failure shows the text. */
inline testing::AssertionResult
HasWords(const std::string & text, const std::vector<std::string> & words)
{
  for (const std::string & word : words)
  {
    if (text.find(word) == std::string::npos)
    {
      return testing::AssertionFailure() << "no '" << word << "' in: " << text;
    }
  }
  return testing::AssertionSuccess();
}

#endif
