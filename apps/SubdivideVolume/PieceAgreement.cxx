// SPDX-License-Identifier: Apache-2.0
#include "PieceAgreement.h"

#include "SlicerDescription.h"

#include "NonOscillatorySubdivision/Target.h"

#include <cstdio>
#include <filesystem>
#include <sstream>

#include <sys/stat.h>

namespace fs = std::filesystem;

namespace
{
/** All of a number. */
std::string
Spell(const double number)
{
  char text[40];
  std::snprintf(text, sizeof(text), "%.17g", number);
  return text;
}

template <typename T>
std::string
Spell(const std::vector<T> & numbers)
{
  std::string text;
  for (const T & number : numbers)
  {
    text += (text.empty() ? "" : " ") + Spell(static_cast<double>(number));
  }
  return text;
}

std::string
Spell(const ImageDescription & image)
{
  std::string text = Spell(image.Grid.Size) + " voxels, spacing " + Spell(image.Grid.Spacing) + ", origin " +
                     Spell(image.Grid.Origin) + ", directions";
  for (const std::vector<double> & direction : image.Grid.Directions)
  {
    text += " (" + Spell(direction) + ")";
  }
  return text + ", " + std::to_string(image.NumberOfComponents) + " x " + GetName(image.Component);
}

/** Sizes and times of files, summed up. */
class Files
{
public:
  void
  Add(const fs::path & path)
  {
    struct stat status = {};
    if (stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode))
    {
      ++m_Number;
      m_Bytes += static_cast<std::uint64_t>(status.st_size);
      const std::int64_t time = status.st_mtim.tv_sec * std::int64_t{ 1000000000 } + status.st_mtim.tv_nsec;
      m_Newest = std::max(m_Newest, time);
    }
  }

  std::string
  Describe() const
  {
    return std::to_string(m_Number) + (m_Number == 1 ? " file of " : " files of ") + std::to_string(m_Bytes) +
           " bytes, changed at " + std::to_string(m_Newest);
  }

private:
  std::uint64_t m_Number = 0;
  std::uint64_t m_Bytes = 0;
  std::int64_t  m_Newest = 0;
};

/** The files of the input: all of a folder, or one with the data files that may be beside it. */
std::string
DescribeFiles(const fs::path & input)
{
  Files           files;
  std::error_code error;
  if (fs::is_directory(input, error))
  {
    for (const fs::directory_entry & entry : fs::recursive_directory_iterator(input))
    {
      files.Add(entry.path());
    }
    return files.Describe();
  }
  files.Add(input);
  for (const char * const ending : { ".raw", ".zraw", ".raw.gz", ".img", ".img.gz", ".hdr" })
  {
    const fs::path data = fs::path(input).replace_extension(ending);
    if (data != input)
    {
      files.Add(data);
    }
  }
  return files.Describe();
}

std::string
DescribeReading(const InputOptions & options)
{
  std::ostringstream text;
  text << "series " << (options.Series.empty() ? "any" : options.Series);
  if (options.Raw)
  {
    text << ", raw with " << options.Raw->HeaderBytes << " bytes to skip" << (options.Raw->IsBigEndian ? ", big" : "");
  }
  if (options.Channel)
  {
    text << ", channel " << *options.Channel;
  }
  if (options.Frame)
  {
    text << ", frame " << *options.Frame;
  }
  return text.str();
}
} // namespace

PieceAgreement
MakePieceAgreement(const Options & options, const ImageDescription & input, const ImageDescription & output)
{
  return {
    { "number of pieces", std::to_string(options.Piece.Pieces) },
    { "input", fs::canonical(options.Input).string() },
    { "state of the input", DescribeFiles(fs::canonical(options.Input)) },
    { "choice of the input", DescribeReading(options.Reading) },
    { "grid of the input", Spell(input) },
    { "grid of the output", Spell(output) },
    { "scheme", options.Scheme },
    { "tension", Spell(options.Tension) },
    { "boundary", options.Boundary },
    { "axes", options.Axes.empty() ? "the first three" : options.Axes },
    { "number of levels", std::to_string(options.Levels) },
    { "kind of voxels", options.Labels ? "labels" : "values" },
    { "choice of metadata", options.Writing.KeepMetadata ? "all" : "some" },
    { "instruction set (--target)", itk::Subdivision::Target::Named(options.Target).GetName() },
    { "version of the program", GetProgramVersion() },
  };
}
