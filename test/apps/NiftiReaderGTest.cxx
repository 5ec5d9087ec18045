// SPDX-License-Identifier: Apache-2.0
// NIfTI files whose voxels are read where they stand: the bytes are those that ITK reads.
#include "TestFolder.h"
#include "VolumeTestAccess.h"
#include "formats/OpenVolume.h"
#include "itk/ItkReader.h"
#include "nifti/NiftiReader.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <zlib.h>

namespace
{
constexpr std::size_t Header = 352;

/** A NIfTI file, number by number, in either byte order. */
class NiftiBytes
{
public:
  NiftiBytes(std::int16_t type, std::size_t componentBytes, bool isSwapped)
    : m_Text(Header, '\0')
    , m_IsSwapped(isSwapped)
  {
    this->Put(0, std::int32_t{ 348 });
    this->Put(70, type);
    this->Put(72, static_cast<std::int16_t>(8 * componentBytes));
    for (std::size_t i = 0; i < 8; ++i)
    {
      this->Put(40 + 2 * i, std::int16_t{ 1 });
      this->Put(76 + 4 * i, 1.0f);
    }
    this->Put(108, static_cast<float>(Header));
    m_Text.replace(344, 4, std::string("n+1\0", 4));
  }

  void
  SetSize(const std::vector<std::int16_t> & size)
  {
    this->Put(40, static_cast<std::int16_t>(size.size()));
    this->Put(68, static_cast<std::int16_t>(size.size() > 4 ? 1007 : 0)); // vectors
    for (std::size_t i = 0; i < size.size(); ++i)
    {
      this->Put(42 + 2 * i, size[i]);
    }
  }

  template <typename T>
  void
  Put(std::size_t place, T number)
  {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &number, sizeof(T));
    if (m_IsSwapped)
    {
      std::reverse(bytes.begin(), bytes.end());
    }
    m_Text.resize(std::max(m_Text.size(), place + sizeof(T)));
    std::copy(bytes.begin(), bytes.end(), m_Text.begin() + static_cast<std::ptrdiff_t>(place));
  }

  template <typename T>
  void
  PutVoxels(const std::vector<T> & voxels)
  {
    for (const T voxel : voxels)
    {
      this->Put(m_Text.size(), voxel);
    }
  }

  const std::string &
  GetText() const
  {
    return m_Text;
  }

private:
  std::string m_Text;
  bool        m_IsSwapped;
};

constexpr std::size_t Voxels = 5 * 4 * 3 * 2;

template <typename T>
std::vector<T>
MakeNumbers()
{
  std::vector<T> numbers(MakeVoxels<T>(Voxels));
  if constexpr (std::is_floating_point_v<T>)
  {
    numbers[7] = std::numeric_limits<T>::quiet_NaN();
    numbers[50] = -std::numeric_limits<T>::infinity();
  }
  return numbers;
}

std::vector<char>
ReadBytes(VolumeReader & reader, const itk::Subdivision::Box & box)
{
  std::uint64_t count = reader.GetDescription().GetVoxelBytes();
  for (const auto & interval : box)
  {
    count *= interval.Size;
  }
  std::vector<char> bytes(count);
  reader.Read(box, bytes.data());
  return bytes;
}

std::unique_ptr<VolumeReader>
Open(const std::string & path)
{
  return OpenVolume(path, {}, [](const std::string &) {});
}

/** Whether the voxels are read where they stand. */
bool
IsPlain(const std::string & path)
{
  return OpenPlainNifti(NiftiHeader(path), { path, path }, ItkReader(path).GetDescription()) != nullptr;
}

/** Compares the whole, and a part, with what ITK reads of the whole. */
void
CompareWithItk(const std::string & path, const std::string & what)
{
  SCOPED_TRACE(what);
  ASSERT_TRUE(IsPlain(path));
  const auto own = Open(path);
  ItkReader  other(path);
  ASSERT_EQ(own->GetDescription().Component, other.GetDescription().Component);
  ASSERT_EQ(own->GetDescription().NumberOfComponents, other.GetDescription().NumberOfComponents);
  const auto whole = ReadBytes(other, GetWholeBox(other));
  EXPECT_EQ(ReadBytes(*own, GetWholeBox(*own)), whole);

  auto box = GetWholeBox(*own);
  box[1] = { 1, 2 };
  const std::uint64_t row = own->GetDescription().Grid.Size[0] * own->GetDescription().GetVoxelBytes();
  const std::uint64_t plane = row * own->GetDescription().Grid.Size[1];
  std::vector<char>   part;
  for (std::uint64_t first = row; first < whole.size(); first += plane)
  {
    const auto begin = whole.begin() + static_cast<std::ptrdiff_t>(first);
    part.insert(part.end(), begin, begin + static_cast<std::ptrdiff_t>(2 * row));
  }
  EXPECT_EQ(ReadBytes(*own, box), part);
}

/** ITK mixes up the components of vectors that are rescaled: two of them are two volumes of its numbers. */
void
CompareVectorsWithItk(const TestFolder & folder, NiftiBytes file)
{
  file.SetSize({ 5, 4, 3, 2 });
  folder.WriteFile("scalars.nii", file.GetText());
  ItkReader  other(folder / "scalars.nii");
  const auto scalars = ReadBytes(other, GetWholeBox(other));
  file.SetSize({ 5, 4, 3, 1, 2 });
  folder.WriteFile("vectors.nii", file.GetText());
  const auto own = Open(folder / "vectors.nii");
  ASSERT_EQ(own->GetDescription().NumberOfComponents, 2u);
  ASSERT_EQ(own->GetDescription().Component, other.GetDescription().Component);
  const auto        bytes = itk::Subdivision::SizeOf(own->GetDescription().Component);
  std::vector<char> vectors(scalars.size());
  for (std::size_t i = 0; i < Voxels; ++i)
  {
    const std::size_t from = i % 2 * (Voxels / 2) + i / 2;
    std::copy_n(scalars.begin() + static_cast<std::ptrdiff_t>(from * bytes),
                bytes,
                vectors.begin() + static_cast<std::ptrdiff_t>(i * bytes));
  }
  EXPECT_EQ(ReadBytes(*own, GetWholeBox(*own)), vectors);
  const std::size_t row = 5 * 2 * bytes;
  EXPECT_EQ(ReadBytes(*own, { { 0, 5 }, { 3, 1 }, { 1, 1 } }),
            std::vector<char>(vectors.begin() + static_cast<std::ptrdiff_t>(7 * row),
                              vectors.begin() + static_cast<std::ptrdiff_t>(8 * row)));
}

template <typename T>
void
TestType(std::int16_t type)
{
  const TestFolder folder;
  for (const bool isSwapped : { false, true })
  {
    for (const auto & [slope, intercept] : { std::pair(0.0f, 0.0f), std::pair(1.0f, 0.0f), std::pair(0.3f, -7.1f) })
    {
      NiftiBytes file(type, sizeof(T), isSwapped);
      file.SetSize({ 5, 4, 3, 2 });
      file.Put(112, slope);
      file.Put(116, intercept);
      file.PutVoxels(MakeNumbers<T>());
      folder.WriteFile("a.nii", file.GetText());
      CompareWithItk(folder / "a.nii", std::string(isSwapped ? "swapped, " : "") + std::to_string(slope));
      CompareVectorsWithItk(folder, file);
    }
  }
}
} // namespace

TEST(NiftiReader, ReadsEachTypeAsItkDoes)
{
  TestType<std::uint8_t>(2);
  TestType<std::int16_t>(4);
  TestType<std::int32_t>(8);
  TestType<float>(16);
  TestType<double>(64);
  TestType<std::int8_t>(256);
  TestType<std::uint16_t>(512);
  TestType<std::uint32_t>(768);
}

TEST(NiftiReader, VoxelsAreWhatTheHeaderSays)
{
  const TestFolder folder;
  NiftiBytes       file(4, 2, true);
  file.SetSize({ 3, 2 });
  file.Put(112, 0.5f);
  file.Put(116, 10.0f);
  file.PutVoxels<std::int16_t>({ 0, 1, -2, 300, -32768, 32767 });
  folder.WriteFile("a.nii", file.GetText());
  const auto reader = Open(folder / "a.nii");
  EXPECT_EQ(ReadAll<float>(*reader), (std::vector<float>{ 10, 10.5f, 9, 160, -16374, 16393.5f }));
  EXPECT_EQ(ReadBox<float>(*reader, { { 1, 2 }, { 1, 1 } }), (std::vector<float>{ -16374, 16393.5f }));
  EXPECT_EQ(reader->GetScratchBytes(4000), 2000u);
}

TEST(NiftiReader, ColoursAndComplexNumbersStandSideBySide)
{
  const TestFolder folder;
  NiftiBytes       colours(128, 3, false);
  colours.SetSize({ 5, 4, 2 });
  colours.PutVoxels(MakeNumbers<std::uint8_t>());
  folder.WriteFile("a.nii", colours.GetText());
  CompareWithItk(folder / "a.nii", "colours");
  EXPECT_EQ(Open(folder / "a.nii")->GetDescription().Kind, VoxelKind::Rgb);
  NiftiBytes complex(32, 8, true);
  complex.SetSize({ 5, 4, 3 });
  complex.PutVoxels(MakeNumbers<float>());
  folder.WriteFile("a.nii", complex.GetText());
  CompareWithItk(folder / "a.nii", "complex numbers");
}

// ITK rescales a part of the components alone.
TEST(NiftiReader, WhatItkRescalesWrongIsRefused)
{
  const TestFolder folder;
  const auto       test = [&](std::int16_t type, std::size_t bytes, const std::vector<std::int16_t> & size) {
    NiftiBytes file(type, bytes, false);
    file.SetSize(size);
    file.Put(112, 2.0f);
    const std::size_t voxels = std::accumulate(size.begin(), size.end(), std::size_t{ 1 }, std::multiplies<>());
    file.PutVoxels(MakeVoxels<std::uint8_t>(voxels * bytes));
    const gzFile gz = gzopen((folder / "a.nii.gz").c_str(), "wb");
    gzwrite(gz, file.GetText().data(), static_cast<unsigned int>(file.GetText().size()));
    gzclose(gz);
    folder.WriteFile("b.nii", file.GetText());
    EXPECT_TRUE(Contains(GetError([&] { Open(folder / "a.nii.gz"); }), "scl_slope")) << type;
    return GetError([&] { Open(folder / "b.nii"); });
  };
  EXPECT_EQ(test(4, 2, { 5, 4, 3, 1, 2 }), "");
  EXPECT_TRUE(Contains(test(128, 3, { 5, 4, 3 }), "scl_slope"));
  EXPECT_TRUE(Contains(test(32, 8, { 5, 4, 3 }), "scl_slope"));
}

// ITK ends the program where such a matrix is to be turned into directions.
TEST(NiftiReader, PlacementsThatAreNotFiniteAreRefused)
{
  const TestFolder folder;
  const auto       getError = [&](std::size_t code, std::size_t place, float number) {
    NiftiBytes file(4, 2, false);
    file.SetSize({ 5, 4, 3, 2 });
    file.Put(280, 1.0f);
    file.Put(300, 1.0f);
    file.Put(320, 1.0f);
    file.Put(code, std::int16_t{ 1 });
    file.Put(place, number);
    file.PutVoxels(MakeNumbers<std::int16_t>());
    folder.WriteFile("a.nii", file.GetText());
    return GetError([&] { Open(folder / "a.nii"); });
  };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(Contains(getError(254, 280, nan), "not finite"));
  EXPECT_TRUE(Contains(getError(254, 324, -std::numeric_limits<float>::infinity()), "not finite"));
  EXPECT_TRUE(Contains(getError(252, 256, nan), "not finite"));
  EXPECT_TRUE(Contains(getError(252, 276, nan), "not finite"));
  EXPECT_EQ(getError(252, 280, nan), ""); // the matrix does not count
  EXPECT_EQ(getError(254, 256, nan), "");
}

// Each reader would make something else of them.
TEST(NiftiReader, SlopesThatAreNotFiniteAreRefused)
{
  const TestFolder folder;
  constexpr float  nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float  infinity = std::numeric_limits<float>::infinity();
  const auto       getError = [&folder](const float slope, const float intercept) {
    NiftiBytes file(4, 2, false);
    file.SetSize({ 5, 4, 3, 2 });
    file.Put(112, slope);
    file.Put(116, intercept);
    file.PutVoxels(MakeNumbers<std::int16_t>());
    folder.WriteFile("a.nii", file.GetText());
    return GetError([&] { Open(folder / "a.nii"); });
  };
  EXPECT_TRUE(Contains(getError(nan, 5.0f), "not finite"));
  EXPECT_TRUE(Contains(getError(2.0f, nan), "not finite"));
  EXPECT_TRUE(Contains(getError(2.0f, infinity), "not finite"));
  EXPECT_TRUE(Contains(getError(-infinity, 3.0f), "not finite"));
  EXPECT_EQ(getError(nan, 0.0f), ""); // as some programs write that there is none
}

// Voxels of a VTK file that would be such a placement.
TEST(NiftiReader, OtherFormatsHaveNoSuchPlacement)
{
  const TestFolder  folder;
  const std::string header = "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET STRUCTURED_POINTS\nDIMENSIONS 9 8 6\n"
                             "SPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA 432\nSCALARS s unsigned_char 1\n"
                             "LOOKUP_TABLE default\n";
  NiftiBytes        placed(4, 2, false);
  placed.SetSize({ 5, 4, 3, 2 });
  placed.Put(254, std::int16_t{ 1 });
  placed.Put(280, std::numeric_limits<float>::quiet_NaN());
  std::string text = header + std::string(432, '\0');
  ASSERT_LT(header.size(), 252u);
  text.replace(252, 96, placed.GetText().substr(252, 96));
  folder.WriteFile("a.vtk", text);
  EXPECT_EQ(GetError([&] { Open(folder / "a.vtk"); }), "");
}

// ITK turns round the order of tensors' components, and some of its versions the signs of displacements.
TEST(NiftiReader, TensorsAndDisplacementsAreLeftToItk)
{
  const TestFolder folder;
  NiftiBytes       file(16, 4, false);
  file.SetSize({ 5, 4, 1, 1, 6 });
  file.PutVoxels(MakeNumbers<float>());
  folder.WriteFile("vectors.nii", file.GetText());
  const ImageDescription vectors = ItkReader(folder / "vectors.nii").GetDescription();
  file.Put(68, std::int16_t{ 1005 });
  folder.WriteFile("a.nii", file.GetText());
  const auto reader = Open(folder / "a.nii");
  ItkReader  other(folder / "a.nii");
  EXPECT_FALSE(IsPlain(folder / "a.nii"));
  EXPECT_EQ(ReadAll<float>(*reader), ReadAll<float>(other));
  EXPECT_NE(
    OpenPlainNifti(NiftiHeader(folder / "vectors.nii"), { folder / "vectors.nii", folder / "vectors.nii" }, vectors),
    nullptr);
  file.Put(68, std::int16_t{ 1006 });
  folder.WriteFile("a.nii", file.GetText());
  EXPECT_EQ(OpenPlainNifti(NiftiHeader(folder / "a.nii"), { folder / "a.nii", folder / "a.nii" }, vectors), nullptr);
}

TEST(NiftiReader, ReadsBothFilesOfAPair)
{
  const TestFolder folder;
  for (const bool isAnalyze : { false, true })
  {
    NiftiBytes file(4, 2, false);
    file.SetSize({ 5, 4, 3, 2 });
    file.Put(108, 6.0f);
    file.PutVoxels(MakeNumbers<std::int16_t>());
    std::string header = file.GetText().substr(0, 348);
    header.replace(344, 4, isAnalyze ? std::string(4, '\0') : std::string("ni1\0", 4));
    folder.WriteFile("a.hdr", header);
    folder.WriteFile("a.img", "sixxxx" + file.GetText().substr(Header));
    for (const std::string name : { "a.hdr", "a.img" })
    {
      const auto reader = Open(folder / name);
      EXPECT_EQ(ReadAll<std::int16_t>(*reader), MakeNumbers<std::int16_t>()) << name;
    }
    EXPECT_NE(OpenPlainNifti(NiftiHeader(folder / "a.hdr"),
                             { folder / "a.hdr", folder / "a.img" },
                             ItkReader(folder / "a.hdr").GetDescription()),
              nullptr);
  }
}

// Which of the two placements the header has, or both, makes no difference to what its units mean.
TEST(NiftiReader, UnitsHoldForSpacingAndOrigin)
{
  const TestFolder folder;
  const auto       test = [&](bool hasQuaternion, bool hasMatrix, int units, double millimetres, double seconds) {
    NiftiBytes file(4, 2, false);
    file.SetSize({ 5, 4, 3, 2 });
    file.Put(123, static_cast<char>(units));
    file.Put(136, 40.0f); // toffset
    file.Put(252, static_cast<std::int16_t>(hasQuaternion ? 1 : 0));
    file.Put(254, static_cast<std::int16_t>(hasMatrix ? 1 : 0));
    const std::array<float, 3> spacing = { 5, 6, 7 };
    const std::array<float, 3> origin = { 100, 200, 300 };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      file.Put(80 + 4 * axis, spacing[axis]);
      file.Put(268 + 4 * axis, origin[axis]);
      file.Put(280 + 20 * axis, spacing[axis]);
      file.Put(292 + 16 * axis, origin[axis]);
    }
    file.Put(92, 8.0f);
    file.PutVoxels(MakeNumbers<std::int16_t>());
    folder.WriteFile("a.nii", file.GetText());
    const auto   reader = Open(folder / "a.nii");
    const auto & grid = reader->GetDescription().Grid;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(grid.Spacing[axis], millimetres * spacing[axis], 1e-12 * grid.Spacing[axis]) << units;
      const double meant = (axis < 2 ? -1 : 1) * millimetres * origin[axis];
      EXPECT_NEAR(grid.Origin[axis], meant, 1e-12 * std::abs(meant)) << units;
    }
    EXPECT_NEAR(grid.Spacing[3], 8 * seconds, 1e-12) << units;
    EXPECT_NEAR(grid.Origin[3], 40 * seconds, 1e-12) << units;
  };
  for (const auto & [hasQuaternion, hasMatrix] : { std::pair(true, true), { true, false }, { false, true } })
  {
    test(hasQuaternion, hasMatrix, 0, 1.0, 1.0); // unknown
    test(hasQuaternion, hasMatrix, 1 + 8, 1e3, 1.0);
    test(hasQuaternion, hasMatrix, 2 + 16, 1.0, 1e-3);
    test(hasQuaternion, hasMatrix, 3 + 24, 1e-3, 1e-6);
    test(hasQuaternion, hasMatrix, 3 + 32, 1e-3, 1.0); // hertz
  }
}
