// SPDX-License-Identifier: Apache-2.0
// The programs' parsers of short texts, and what they check of DICOM slices, on what a fuzzer makes up: layouts of raw
// files, numbers of bytes, options, pieces, descriptions in TIFF files, patterns of names, compressed streams.

#include "FuzzBytes.h"
#include "FuzzFolder.h"

#include "../../apps/SubdivideVolume/PieceChoice.h"
#include "commandline/CommandLine.h"
#include "deflate/InflateStream.h"
#include "dicom/DicomGeometry.h"
#include "plain/RawReader.h"
#include "text/HeaderText.h"
#include "tiff/TiffStack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace
{

void
FuzzRawLayout(const std::string & text)
{
  const RawLayout layout = ParseRawLayout(text);
  double          bytes = static_cast<double>(layout.NumberOfComponents);
  bytes *= static_cast<double>(itk::Subdivision::SizeOf(layout.Component));
  FuzzExpect(!layout.Size.empty() && layout.Size.size() <= 4, "a raw layout of no axes, or too many");
  for (const std::uint64_t size : layout.Size)
  {
    bytes *= static_cast<double>(size);
  }
  FuzzExpect(bytes >= 1.0 && bytes < std::ldexp(1.0, 63), "a raw layout that is empty or overflows");
}

void
FuzzBytesOption(const std::string & text)
{
  const std::uint64_t bytes = ParseBytes(text);
  FuzzExpect(bytes >= 1 && bytes <= 1000000000000000000u, "a number of bytes beyond what is allowed");
}

void
FuzzPiece(const std::string & text)
{
  const PieceChoice choice = ParsePieceChoice(text);
  FuzzExpect(choice.IsStatus || (choice.Number >= 1 && choice.Number <= choice.Pieces), "a piece that is none");
}

/** One option, without a blank, so that it is none of those that print something. */
void
FuzzOptions(FuzzBytes & bytes)
{
  constexpr const char * names[] = { "--series=", "--spacing=", "--origin=", "--channel=", "--frame=", "--raw=" };
  std::string            option = names[bytes.Below(std::size(names))] + bytes.Rest();
  option = option.c_str();
  std::string  program = "program";
  char *       arguments[] = { program.data(), option.data(), nullptr };
  CLI::App     app;
  InputOptions options;
  AddInputOptions(app, options);
  AddRawOption(app, "--raw", options.Raw, "IN");
  ParseArguments(app, 2, arguments);
  for (const auto & numbers : { options.Spacing, options.Origin })
  {
    for (const double number : numbers.value_or(std::vector<double>()))
    {
      FuzzExpect(std::isfinite(number), "a place that is none");
    }
  }
}

void
CheckStack(const std::optional<TiffStack> & stack, const std::uint64_t pages)
{
  if (!stack)
  {
    return;
  }
  const double planes =
    static_cast<double>(stack->Slices) * static_cast<double>(stack->Channels) * static_cast<double>(stack->Frames);
  FuzzExpect(planes >= 1.0 && planes == static_cast<double>(stack->Planes.size()), "a stack of other than its planes");
  for (const std::uint64_t plane : stack->Planes)
  {
    FuzzExpect(plane < pages, "a plane beyond the file's pages");
  }
}

/** Whether a text may count 100 000 planes or more and yet no more than a file may have. They are allowed, but listing
 * them takes so long under sanitizers that a fuzzer would do little else. */
bool
MayCountManyPlanes(const std::string & text)
{
  constexpr const char * digits = "0123456789";
  for (std::size_t first = 0; (first = text.find_first_of(digits, first)) != std::string::npos;)
  {
    const std::size_t end = std::min(text.find_first_not_of(digits, first), text.size());
    if (end - first >= 6 && end - first <= 8)
    {
      return true;
    }
    first = end;
  }
  return false;
}

void
FuzzImageJ(const std::string & text)
{
  if (!MayCountManyPlanes(text))
  {
    CheckStack(ParseImageJ(text), std::numeric_limits<std::uint64_t>::max());
  }
}

void
FuzzNumbers(const std::string & text)
{
  double value = 0.0;
  std::memcpy(&value, text.data(), std::min(text.size(), sizeof(value)));
  if (std::isfinite(value))
  {
    FuzzExpect(ParseReal("file", "field", FormatReal(value)) == value, "a number is not read as it was written");
  }
  ParseSizes("file", "field", text, SplitWords(text).size());
  ParseReals("file", "field", text, SplitWords(text).size());
}

void
FuzzPattern(FuzzBytes & bytes)
{
  const std::int64_t first = static_cast<std::int8_t>(bytes.Byte());
  const std::int64_t last = static_cast<std::int8_t>(bytes.Byte());
  const std::int64_t step = static_cast<std::int8_t>(bytes.Byte());
  const auto         names = ExpandPattern("file", bytes.Rest(), first, last, step);
  FuzzExpect(names.size() <= 256, "more names than numbers");
  FuzzExpect(names.size() < 2 || names[0] != names[1], "two numbers with one name");
}

/** A stream as it stands in a file, read in two parts. */
void
FuzzStream(const std::string & text)
{
  static const FuzzFolder folder;
  const std::string       path = folder.Write("stream", text);
  InflateStream           stream({ path, 0, text.size() });
  std::vector<char>       part(100);
  stream.ReadAt(0, part.data(), 10);
  stream.ReadAt(10, part.data(), 90);
  stream.CheckEnd();
}

double
ChooseNumber(FuzzBytes & bytes)
{
  const unsigned int byte = bytes.Byte();
  return byte < 250    ? (static_cast<double>(byte) - 125.0) / 8.0
         : byte == 250 ? 1e300
         : byte == 251 ? -1e300
                       : (static_cast<double>(byte) - 250.0) * 1e-4;
}

/** A few slices the like of which a header's reader gives, and the grid that they make. */
void
FuzzDicom(FuzzBytes & bytes)
{
  DicomSeries        series;
  const unsigned int shared = bytes.Byte();
  for (unsigned int i = 1 + bytes.Below(6); i > 0; --i)
  {
    DicomHeader header;
    header.FileName = "slice" + std::to_string(i);
    header.Columns = 4 + (shared & 1);
    header.Rows = 4 + bytes.Below(32) / 31;
    header.BitsAllocated = 16;
    header.InstanceNumber = static_cast<double>(bytes.Below(8));
    const std::array<double, 2> spacing = { 0.5, (shared & 2) != 0 ? 0.5 : ChooseNumber(bytes) };
    for (unsigned int frames = 1 + bytes.Below(8) / 7; frames > 0; --frames)
    {
      DicomFrame frame;
      frame.PixelSpacing = spacing;
      if ((shared & 4) == 0)
      {
        frame.Position = { { ChooseNumber(bytes), ChooseNumber(bytes), ChooseNumber(bytes) } };
      }
      if ((shared & 8) == 0)
      {
        frame.Orientation = { { 1, 0, 0, 0, 1, 0 } };
        (*frame.Orientation)[bytes.Below(6)] += bytes.Below(16) == 0 ? ChooseNumber(bytes) : 0.0;
      }
      frame.PhaseKey = { ChooseNumber(bytes) };
      header.Frames.push_back(frame);
    }
    series.Headers.push_back(header);
  }
  InputOptions options;
  if ((shared & 16) != 0)
  {
    options.Frame = bytes.Below(4);
  }
  if ((shared & 32) != 0)
  {
    options.Spacing = std::vector<double>{ 1, 1, 1 };
  }
  const DicomVolume volume = ArrangeDicomSlices(series, options, [](const std::string &) {});
  FuzzExpect(volume.Grid.Size.size() == 3 && volume.Grid.Size[2] == volume.Slices.size() && !volume.Slices.empty(),
             "a volume of other than its slices");
  FuzzExpect(volume.Grid.Spacing[2] > 0.0 && std::isfinite(volume.Grid.Spacing[2]), "slices without a distance");
}

void
Fuzz(FuzzBytes & bytes)
{
  switch (bytes.Below(10))
  {
    case 0:
      return FuzzRawLayout(bytes.Rest());
    case 1:
      return FuzzBytesOption(bytes.Rest());
    case 2:
      return FuzzPiece(bytes.Rest());
    case 3:
      return FuzzOptions(bytes);
    case 4:
      return FuzzImageJ(bytes.Rest());
    case 5:
    {
      const unsigned int pages = bytes.Byte();
      return CheckStack(ParseOme(bytes.Rest(), pages), pages);
    }
    case 6:
      return FuzzNumbers(bytes.Rest());
    case 7:
      return FuzzPattern(bytes);
    case 8:
      return FuzzStream(bytes.Rest());
    default:
      return FuzzDicom(bytes);
  }
}

} // namespace

int
LLVMFuzzerTestOneInput(const std::uint8_t * const data, const std::size_t size)
{
  FuzzBytes bytes(data, size);
  try
  {
    Fuzz(bytes);
  }
  // What a text is refused with; anything else is a fault.
  catch (const std::runtime_error &)
  {}
  catch (const std::invalid_argument &)
  {}
  return 0;
}
