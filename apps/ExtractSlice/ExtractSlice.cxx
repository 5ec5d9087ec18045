// SPDX-License-Identifier: Apache-2.0
// ExtractSlice INPUT OUTPUT: writes the middle slice of a volume, or of the first volume of a series in time, as float.
// INPUT is an image file, or a folder with a DICOM series or with slices.

#include "formats/CreateVolume.h"
#include "formats/InputSafety.h"
#include "formats/OpenVolume.h"
#include "system/process/WatchedRun.h"
#include "text/OneLineMessage.h"
#include "volumes/RealVoxels.h"
#include "volumes/VolumeWriter.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

namespace
{
void
ExtractSlice(const std::string & inputPath, const std::string & outputPath)
{
  const auto warn = [](const std::string & warning) {
    std::fprintf(stderr, "ExtractSlice: warning: %s\n", MakeOneLine(warning).c_str());
  };
  const auto       reader = OpenVolume(inputPath, {}, warn);
  ImageDescription slice = reader->GetDescription();
  ImageGrid &      grid = slice.Grid;
  slice.Component = itk::Subdivision::ElementType::Float;
  itk::Subdivision::Box box;
  for (std::size_t axis = 0; axis < grid.Size.size(); ++axis)
  {
    const std::uint64_t index = axis == 2 ? grid.Size[axis] / 2 : 0;
    box.push_back({ static_cast<std::int64_t>(index), axis < 2 ? grid.Size[axis] : 1 });
    for (std::size_t row = 0; row < grid.Origin.size(); ++row)
    {
      grid.Origin[row] += static_cast<double>(index) * grid.Spacing[axis] * grid.Directions[axis][row];
    }
    grid.Size[axis] = box.back().Size;
  }
  std::vector<float> values(slice.GetNumberOfVoxels() * slice.NumberOfComponents);
  ReadReals(*reader, box, values.data());

  const std::size_t axes = std::min<std::size_t>(grid.Size.size(), 3);
  box.resize(axes);
  grid.Size.resize(axes);
  grid.Spacing.resize(axes);
  grid.Origin.resize(axes);
  grid.Directions.resize(axes);
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    box[axis].First = 0;
    grid.Directions[axis].resize(axes);
  }
  const auto writer = CreateVolume(outputPath, {}, warn);
  CheckInputStays(inputPath, *reader, outputPath, *writer, InPlace::Allowed);
  writer->Begin(slice);
  writer->Write(box, values.data());
  writer->Commit();
}

int
RunProgram(const char * inputPath, const char * outputPath)
{
  try
  {
    ExtractSlice(inputPath, outputPath);
    return 0;
  }
  catch (const std::exception & error)
  {
    std::fprintf(stderr, "ExtractSlice: %s\n", MakeOneLine(error.what()).c_str());
    return 1;
  }
}
} // namespace

int
main(int argc, char * argv[])
{
  const int first = argc > 1 && std::strcmp(argv[1], "--") == 0 ? 2 : 1;
  if (argc != first + 2)
  {
    std::fprintf(stderr, "Usage: ExtractSlice INPUT OUTPUT\n");
    return 2;
  }
  return RunWatched([&] { return RunProgram(argv[first], argv[first + 1]); });
}
