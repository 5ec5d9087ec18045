// SPDX-License-Identifier: Apache-2.0
#ifndef VolumeTestImages_h
#define VolumeTestImages_h

#include "formats/CreateVolume.h"
#include "formats/OpenVolume.h"
#include "volumes/VolumeReader.h"
#include "volumes/VolumeWriter.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

/** Images for the tests of the programs' files. */
namespace VolumeTest
{
inline itk::Subdivision::Box
GetWholeBox(const std::vector<std::uint64_t> & size)
{
  itk::Subdivision::Box box;
  for (const std::uint64_t count : size)
  {
    box.push_back({ 0, count });
  }
  return box;
}

/** A grid in an oblique place; directions are turned about the last two axes. */
inline ImageDescription
MakeDescription(const std::vector<std::uint64_t> & size,
                itk::Subdivision::ElementType      type,
                unsigned int                       components = 1)
{
  ImageDescription description;
  description.Grid.Size = size;
  for (std::size_t axis = 0; axis < size.size(); ++axis)
  {
    description.Grid.Spacing.push_back(0.5 + 0.25 * static_cast<double>(axis));
    description.Grid.Origin.push_back(-7.125 + 3.0 * static_cast<double>(axis));
    std::vector<double> direction(size.size(), 0.0);
    direction[axis] = 1.0;
    description.Grid.Directions.push_back(direction);
  }
  if (size.size() > 1)
  {
    const std::size_t last = size.size() - 1;
    description.Grid.Directions[last - 1][last - 1] = 0.8;
    description.Grid.Directions[last - 1][last] = 0.6;
    description.Grid.Directions[last][last - 1] = 0.6;
    description.Grid.Directions[last][last] = -0.8;
  }
  description.Component = type;
  description.NumberOfComponents = components;
  description.Kind = components == 1 ? VoxelKind::Scalar : VoxelKind::Vector;
  return description;
}

/** Bytes that compress a little and differ from place to place. For real types they are small numbers. */
inline std::vector<char>
MakeVoxels(const ImageDescription & description)
{
  const std::uint64_t count = description.GetNumberOfVoxels() * description.NumberOfComponents;
  std::vector<char>   bytes(count * itk::Subdivision::SizeOf(description.Component));
  itk::Subdivision::WithElementType(description.Component, [&](auto tag) {
    using Type = typename decltype(tag)::Type;
    std::uint32_t state = 1;
    for (std::uint64_t i = 0; i < count; ++i)
    {
      state = state * 1664525u + 1013904223u;
      const auto value = static_cast<Type>((state >> 24) / 3 + i % 40);
      std::memcpy(bytes.data() + i * sizeof(Type), &value, sizeof(Type));
    }
  });
  return bytes;
}

inline void
WriteVolume(
  const std::string &       path,
  const ImageDescription &  description,
  const std::vector<char> & voxels,
  const OutputOptions &     options = {},
  const WarningSink &       warn = [](const std::string &) {})
{
  const auto writer = CreateVolume(path, options, warn);
  writer->Begin(description);
  writer->Write(GetWholeBox(description.Grid.Size), voxels.data());
  writer->Commit();
}

inline std::vector<char>
ReadVoxels(VolumeReader & reader, const itk::Subdivision::Box & box)
{
  std::uint64_t count = reader.GetDescription().GetVoxelBytes();
  for (const auto & interval : box)
  {
    count *= interval.Size;
  }
  std::vector<char> voxels(count);
  reader.Read(box, voxels.data());
  return voxels;
}

inline std::unique_ptr<VolumeReader>
Open(const std::string & path)
{
  return OpenVolume(path, {}, [](const std::string &) {});
}

inline std::vector<char>
ReadAll(const std::string & path)
{
  const auto reader = Open(path);
  return ReadVoxels(*reader, GetWholeBox(reader->GetDescription().Grid.Size));
}

/** The message of the error that a function ends in; empty if it does not. */
template <typename TFunction>
std::string
GetError(TFunction && function)
{
  try
  {
    function();
  }
  catch (const std::exception & error)
  {
    return error.what();
  }
  return "";
}
} // namespace VolumeTest

#endif
