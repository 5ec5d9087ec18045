// SPDX-License-Identifier: Apache-2.0
#include "headers/NrrdHeader.h"
#include "headers/DataFiles.h"
#include "headers/NrrdAxes.h"
#include "headers/NrrdFields.h"
#include "system/files/InputFile.h"
#include "text/HeaderText.h"
#include "volumes/DescriptionCheck.h"

#include <algorithm>

namespace
{
using itk::Subdivision::ElementType;

const std::map<std::string, ElementType> Types = {
  { "signed char", ElementType::Int8 },
  { "int8", ElementType::Int8 },
  { "int8_t", ElementType::Int8 },
  { "uchar", ElementType::UInt8 },
  { "unsigned char", ElementType::UInt8 },
  { "uint8", ElementType::UInt8 },
  { "uint8_t", ElementType::UInt8 },
  { "short", ElementType::Int16 },
  { "short int", ElementType::Int16 },
  { "signed short", ElementType::Int16 },
  { "signed short int", ElementType::Int16 },
  { "int16", ElementType::Int16 },
  { "int16_t", ElementType::Int16 },
  { "ushort", ElementType::UInt16 },
  { "unsigned short", ElementType::UInt16 },
  { "unsigned short int", ElementType::UInt16 },
  { "uint16", ElementType::UInt16 },
  { "uint16_t", ElementType::UInt16 },
  { "int", ElementType::Int32 },
  { "signed int", ElementType::Int32 },
  { "int32", ElementType::Int32 },
  { "int32_t", ElementType::Int32 },
  { "uint", ElementType::UInt32 },
  { "unsigned int", ElementType::UInt32 },
  { "uint32", ElementType::UInt32 },
  { "uint32_t", ElementType::UInt32 },
  { "longlong", ElementType::Int64 },
  { "long long", ElementType::Int64 },
  { "long long int", ElementType::Int64 },
  { "signed long long", ElementType::Int64 },
  { "signed long long int", ElementType::Int64 },
  { "int64", ElementType::Int64 },
  { "int64_t", ElementType::Int64 },
  { "ulonglong", ElementType::UInt64 },
  { "unsigned long long", ElementType::UInt64 },
  { "unsigned long long int", ElementType::UInt64 },
  { "uint64", ElementType::UInt64 },
  { "uint64_t", ElementType::UInt64 },
  { "float", ElementType::Float },
  { "double", ElementType::Double },
};

PlainEncoding
GetEncoding(const std::string & path, const std::string & name)
{
  static const std::map<std::string, PlainEncoding> encodings = {
    { "raw", PlainEncoding::Raw },    { "gz", PlainEncoding::Compressed }, { "gzip", PlainEncoding::Compressed },
    { "ascii", PlainEncoding::Text }, { "text", PlainEncoding::Text },     { "txt", PlainEncoding::Text },
    { "hex", PlainEncoding::Hex },
  };
  const auto found = encodings.find(name);
  if (found == encodings.end())
  {
    FailToRead(path, "its encoding " + name + " is not supported; raw, gzip, ascii and hex are");
  }
  return found->second;
}

std::vector<std::string>
FindDataFiles(const std::string & path, const NrrdFields & fields)
{
  const std::string              value = fields.Find("datafile").value_or("");
  const std::vector<std::string> words = SplitWords(value);
  if (words.empty())
  {
    return {};
  }
  const bool isPattern = words.size() >= 4 && words[0].find('%') != std::string::npos;
  // How many axes a file has may be said, and follows from the number of files as well: they are alike.
  if (words[0] == "LIST")
  {
    if (fields.ListedNames.empty())
    {
      FailToRead(path, "its header lists no data files");
    }
    return fields.ListedNames;
  }
  if (isPattern)
  {
    return ExpandPattern(path,
                         words[0],
                         ParseInteger(path, "data file", words[1]),
                         ParseInteger(path, "data file", words[2]),
                         ParseInteger(path, "data file", words[3]));
  }
  return { value };
}

/** The frame that components of vectors and tensors refer to, turned into LPS; empty if it is none of three axes. */
std::string
TurnMeasurementFrame(const std::string & path, std::string text, const std::vector<double> & signs)
{
  std::replace_if(text.begin(), text.end(), [](char c) { return c == '(' || c == ',' || c == ')'; }, ' ');
  constexpr std::size_t axes = 3;
  if (SplitWords(text).size() != axes * axes)
  {
    return {};
  }
  const auto  numbers = ParseReals(path, "measurement frame", text, axes * axes);
  std::string turned;
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    turned += (i % axes > 0 ? "," : i > 0 ? ") (" : "(") + FormatReal(signs[i % axes] * numbers[i]);
  }
  return turned + ")";
}

/** What the header says besides the grid. A space that was turned into LPS is none of it. */
void
CopyMetadata(const std::string & path, const NrrdFields & fields, ImageDescription & description)
{
  description.Metadata = fields.KeyValues;
  const std::string space = ToLower(fields.Find("space").value_or("lps"));
  const auto        signs = GetSigns(space, 3);
  const bool        isTurned = signs != std::vector<double>(3, 1.0);
  const bool        isLps = space == "lps" || space == "left-posterior-superior";
  for (const char * const name : { "content", "sample units", "space units", "units", "measurement frame", "space" })
  {
    std::string value = fields.Find(NormaliseNrrdName(name)).value_or("");
    if (isTurned && std::string(name) == "measurement frame")
    {
      value = TurnMeasurementFrame(path, value, signs);
    }
    if (!value.empty() && !(std::string(name) == "space" && (isTurned || isLps)))
    {
      description.Metadata[std::string("NRRD_") + name] = value;
    }
  }
}

bool
IsBigEndian(const std::string & path, const NrrdFields & fields, ElementType type)
{
  const std::string endian = ToLower(fields.Find("endian").value_or(""));
  if (endian != "little" && endian != "big" && !(endian.empty() && itk::Subdivision::SizeOf(type) == 1))
  {
    FailToRead(path, "its header does not say whether the byte order is little or big");
  }
  return endian == "big";
}
/** Fills in the type of the numbers, and how they stand in the files. */
void
DescribeNumbers(const std::string & path, const NrrdFields & fields, PlainLayout & layout)
{
  const std::string type = ToLower(fields.Get("type"));
  const auto        known = Types.find(type);
  if (known == Types.end())
  {
    FailToRead(path, "voxels of the type '" + type + "' are not supported");
  }
  layout.Description.Format = "NRRD";
  layout.Description.Component = known->second;
  layout.Encoding = GetEncoding(path, ToLower(fields.Get("encoding")));
  layout.IsBigEndian = layout.Encoding != PlainEncoding::Text && IsBigEndian(path, fields, known->second);
}

void
LocateNumbers(const std::string & path, const NrrdFields & fields, PlainLayout & layout)
{
  const bool isCompressed = layout.Encoding == PlainEncoding::Compressed;
  DataFiles  files;
  files.HeaderEnd = fields.End;
  const std::int64_t lines = ParseInteger(path, "line skip", fields.Find("lineskip").value_or("0"));
  files.ByteSkip = ParseInteger(path, "byte skip", fields.Find("byteskip").value_or("0"));
  if (lines < 0 || files.ByteSkip < -1 || (isCompressed && files.ByteSkip < 0))
  {
    FailToRead(path, "its header has a negative number of lines or bytes to skip");
  }
  files.LineSkip = static_cast<std::uint64_t>(lines);
  files.Names = FindDataFiles(path, fields);
  layout.InflatedOffset = isCompressed ? static_cast<std::uint64_t>(files.ByteSkip) : 0;
  LocateData(path, files, layout);
}
} // namespace

PlainLayout
ReadNrrdHeader(const std::string & path)
{
  const InputFile    file(path);
  const NrrdFields   fields(file);
  PlainLayout        layout;
  ImageDescription & description = layout.Description;
  DescribeNumbers(path, fields, layout);
  NrrdAxes(path, fields).Describe(description);
  CheckDescription(path, description);
  CopyMetadata(path, fields, description);
  LocateNumbers(path, fields, layout);
  if (layout.Encoding == PlainEncoding::Compressed && layout.Sections.size() > 1)
  {
    throw HeaderNotUnderstood("several compressed data files");
  }
  return layout;
}

ImageDescription
DescribeNrrd(const std::string & path)
{
  const InputFile  file(path);
  const NrrdFields fields(file);
  PlainLayout      layout;
  NrrdAxes         axes(path, fields);
  axes.MoveComponentsFirst();
  DescribeNumbers(path, fields, layout);
  axes.Describe(layout.Description);
  CheckDescription(path, layout.Description);
  CopyMetadata(path, fields, layout.Description);
  return layout.Description;
}

void
ReplaceNrrdMetadata(const std::string & path, ImageDescription & description)
{
  const InputFile  file(path);
  const NrrdFields fields(file);
  const auto       signs = GetSigns(ToLower(fields.Find("space").value_or("")), 2);
  if (signs[0] != signs[1]) // ITK up to 5.2 turns left where anterior is to be turned
  {
    FailToRead(path, "with axes like its own, the space left-anterior-superior is not supported; save it in another");
  }
  CopyMetadata(path, fields, description);
}

PlainLayout
ReadNrrdNumbers(const std::string & path)
{
  const InputFile  file(path);
  const NrrdFields fields(file);
  PlainLayout      layout;
  DescribeNumbers(path, fields, layout);
  layout.Description.Grid.Size = NrrdAxes(path, fields).GetSizes();
  LocateNumbers(path, fields, layout);
  return layout;
}
