// SPDX-License-Identifier: Apache-2.0
#include "TestFolder.h"
#include "VolumeTestImages.h"

#include "headers/Metadata.h"
#include "itk/ItkReader.h"

#include <gtest/gtest.h>

using namespace VolumeTest;
using itk::Subdivision::ElementType;

namespace
{
ImageDescription
MakeWithMetadata(const std::string & format, const std::map<std::string, std::string> & metadata)
{
  ImageDescription description = MakeDescription({ 4, 3, 2 }, ElementType::UInt8);
  description.Format = format;
  description.Metadata = metadata;
  return description;
}

const std::map<std::string, std::string> Keys = {
  { "dim[1]", "4" },
  { "pixdim[1]", "0.5" },
  { "srow_x", "1 0 0 0" },
  { "qoffset_x", "3" },
  { "ITK_FileNotes", "x" },
  { "Segment0_Extent", "0 1" },
  { "0028|0010", "3" },
  { "0020|0032", "0\\0\\0" },
  { "0018|0050", "2.5" },
  { "0010|0010", "Doe^Jane" },
  { "PatientName", "Doe" },
  { "Origin", "0 0 0" },
  { "ElementSpacing", "9 9 9" },
  { "DimSize", "1 1 1" },
  { "spacings", "9 9 9" },
  { "space origin", "(9,9,9)" },
  { "note", "kept" },
  { "Segment0_Name", "liver" },
};
} // namespace

TEST(Metadata, OnlyWhatStaysTrueIsKept)
{
  for (const auto style : { MetadataStyle::MetaImage, MetadataStyle::Nrrd, MetadataStyle::Other })
  {
    const auto selected = SelectMetadata(MakeWithMetadata("NRRD", Keys), style, false);
    EXPECT_EQ(selected.Keys, (std::map<std::string, std::string>{ { "Segment0_Name", "liver" } }));
    EXPECT_TRUE(selected.Fields.empty());
  }
}

TEST(Metadata, TheRestIsKeptOnRequestButNoFieldAndNothingOfTheGrid)
{
  const auto meta = SelectMetadata(MakeWithMetadata("NRRD", Keys), MetadataStyle::MetaImage, true).Keys;
  for (const char * const key : { "dim[1]",
                                  "pixdim[1]",
                                  "srow_x",
                                  "qoffset_x",
                                  "ITK_FileNotes",
                                  "Segment0_Extent",
                                  "0028|0010",
                                  "0020|0032",
                                  "0018|0050",
                                  "Origin",
                                  "ElementSpacing",
                                  "DimSize" })
  {
    EXPECT_EQ(meta.count(key), 0u) << key;
  }
  EXPECT_EQ(meta.at("note"), "kept");
  EXPECT_EQ(meta.at("0010|0010"), "Doe^Jane");
  EXPECT_EQ(meta.at("Input_ElementSpacing"), "9 9 9");
  const auto nrrd = SelectMetadata(MakeWithMetadata("MetaImage", Keys), MetadataStyle::Nrrd, true).Keys;
  EXPECT_EQ(nrrd.count("spacings"), 0u);
  EXPECT_EQ(nrrd.at("Input_spacings"), "9 9 9");
  EXPECT_EQ(nrrd.at("ElementSpacing"), "9 9 9");
}

TEST(Metadata, UnitsGoFromFormatToFormat)
{
  const TestFolder folder;
  const auto description = MakeWithMetadata("NRRD", { { "NRRD_space units", "\"microns\" \"microns\" \"microns\"" } });
  const auto voxels = MakeVoxels(description);
  WriteVolume(folder / "a.mha", description, voxels);
  EXPECT_NE(folder.ReadFile("a.mha").find("DistanceUnits = um\n"), std::string::npos);
  WriteVolume(folder / "b.nrrd", Open(folder / "a.mha")->GetDescription(), voxels);
  EXPECT_NE(folder.ReadFile("b.nrrd").find("space units: \"um\" \"um\" \"um\"\n"), std::string::npos);
  EXPECT_EQ(GetUnit(Open(folder / "b.nrrd")->GetDescription()), "um");
}

// However a key or a value looks, both readers find the grid that was meant and the voxels.
TEST(Metadata, NoKeyBecomesAField)
{
  const std::map<std::string, std::string> hostile = {
    { "Origin", "9 9 9" },
    { "Offset = 9 9 9\nx", "1" },
    { "x", "1\nElementSpacing = 9 9 9\nElementDataFile = LOCAL" },
    { "ElementDataFile", "LOCAL" },
    { "", "empty" },
    { "# comment", "1" },
    { "spacings: 9 9 9", "1" },
    { "NRRD_space", "right-anterior-superior" },
    { "NRRD_space directions", "none none none" },
    { "NRRD_space units", "\"mm\"\nspace origin: (9,9,9)" },
    { "NRRD_sample units", "HU\n\nsizes: 1 1 1" },
    { "DistanceUnits", "mm\nDimSize = 9 9 9" },
    { "Modality", "MET_MOD_CT\nDimSize = 9 9 9" },
    { "long", std::string(40000, 'v') },
    { std::string(400, 'k'), "v" },
    { "y\\n", "back\\slash\nline\r" },
  };
  for (const char * const format : { "NRRD", "MetaImage", "NIfTI" })
  {
    const auto description = MakeWithMetadata(format, hostile);
    const auto voxels = MakeVoxels(description);
    for (const std::string name : { "a.mha", "a.mhd", "a.nrrd", "a.nhdr", "a.nii", "a.h5" })
    {
      SCOPED_TRACE(name + " from " + format);
      const TestFolder folder;
      OutputOptions    options;
      options.KeepMetadata = true;
      WriteVolume(folder / name, description, voxels, options);
      const auto own = Open(folder / name);
      ItkReader  itkReader(folder / name);
      for (VolumeReader * const reader : { own.get(), static_cast<VolumeReader *>(&itkReader) })
      {
        EXPECT_EQ(reader->GetDescription().Grid.Size, description.Grid.Size);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          EXPECT_NEAR(reader->GetDescription().Grid.Origin[axis], description.Grid.Origin[axis], 1e-6);
          EXPECT_NEAR(reader->GetDescription().Grid.Spacing[axis], description.Grid.Spacing[axis], 1e-6);
        }
        EXPECT_EQ(ReadVoxels(*reader, GetWholeBox(description.Grid.Size)), voxels);
      }
    }
  }
}

TEST(Metadata, AMeasurementFrameIsLostUnlessTheOutputIsAnNrrdOfItsAxes)
{
  const std::string frame = "(0,1,0) (1,0,0) (0,0,1)";
  const auto        loses = [](const std::string & format, const std::string & value, std::size_t axes, bool isToNrrd) {
    ImageDescription description = MakeWithMetadata(format, { { "NRRD_measurement frame", value } });
    description.Grid.Size.resize(axes, 2);
    EXPECT_EQ(SelectMetadata(description, MetadataStyle::Nrrd, false).Fields.count("measurement frame"),
              format == "NRRD" && axes == 3 && value.front() == '(' ? 1u : 0u);
    return LosesMeasurementFrame(description, isToNrrd);
  };
  EXPECT_TRUE(loses("NRRD", frame, 3, false));
  EXPECT_FALSE(loses("NRRD", frame, 3, true));
  EXPECT_TRUE(loses("NRRD", frame, 4, true));
  EXPECT_FALSE(loses("NRRD", "(1,0,0) (0,1,0) (0,0,1)", 3, false));
  EXPECT_FALSE(loses("NRRD", "none none none", 3, false));
  EXPECT_FALSE(loses("MetaImage", frame, 3, false));
}
