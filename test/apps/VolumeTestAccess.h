// SPDX-License-Identifier: Apache-2.0
#ifndef VolumeTestAccess_h
#define VolumeTestAccess_h

#include "volumes/VolumeReader.h"
#include "volumes/VolumeWriter.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <numeric>
#include <string>
#include <vector>

/** Keeps warnings. */
class KeptWarnings
{
public:
  WarningSink
  GetSink()
  {
    return [this](const std::string & warning) { m_Texts.push_back(warning); };
  }

  std::size_t
  GetNumber() const
  {
    return m_Texts.size();
  }

  bool
  Mention(const std::string & text) const
  {
    return std::any_of(
      m_Texts.begin(), m_Texts.end(), [&](const std::string & own) { return own.find(text) != std::string::npos; });
  }

private:
  std::vector<std::string> m_Texts;
};

inline itk::Subdivision::Box
GetWholeBox(const VolumeReader & reader)
{
  itk::Subdivision::Box box;
  for (const std::uint64_t size : reader.GetDescription().Grid.Size)
  {
    box.push_back({ 0, size });
  }
  return box;
}

template <typename T>
std::vector<T>
ReadBox(VolumeReader & reader, const itk::Subdivision::Box & box)
{
  std::uint64_t count = reader.GetDescription().NumberOfComponents;
  for (const auto & interval : box)
  {
    count *= interval.Size;
  }
  std::vector<T> voxels(count);
  reader.Read(box, voxels.data());
  return voxels;
}

template <typename T>
std::vector<T>
ReadAll(VolumeReader & reader)
{
  return ReadBox<T>(reader, GetWholeBox(reader));
}

/** Numbers that differ, over the whole range of a type of integers. */
template <typename T>
std::vector<T>
MakeVoxels(std::size_t count)
{
  std::vector<T> voxels(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::uint64_t mixed = (i + 1) * 0x9E3779B97F4A7C15u;
    if constexpr (std::is_floating_point<T>::value)
    {
      voxels[i] = static_cast<T>(static_cast<std::int64_t>(mixed)) / 7;
    }
    else
    {
      voxels[i] = static_cast<T>(mixed >> (64 - 8 * sizeof(T)));
    }
  }
  return voxels;
}

/** What an operation throws; empty if it does not. */
template <typename TOperation>
std::string
GetError(TOperation && operation)
{
  try
  {
    operation();
  }
  catch (const std::exception & error)
  {
    return error.what();
  }
  return "";
}

inline bool
Contains(const std::string & text, const std::string & part)
{
  return text.find(part) != std::string::npos;
}

#endif
