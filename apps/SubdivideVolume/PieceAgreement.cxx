// SPDX-License-Identifier: Apache-2.0
#include "PieceAgreement.h"

#include "SlicerDescription.h"
#include "system/files/FileState.h"

#include "NonOscillatorySubdivision/Target.h"

#include <cstdio>
#include <filesystem>
#include <sstream>

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
