// SPDX-License-Identifier: Apache-2.0
#include "dicom/DicomSeries.h"
#include "system/process/WatchedTask.h"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{
std::vector<fs::path>
FindFiles(const fs::path & path)
{
  const bool isIndex = path.filename() == "DICOMDIR" && fs::is_regular_file(path);
  if (!isIndex && !fs::is_directory(path))
  {
    return { path };
  }
  const fs::path        folder = isIndex ? fs::absolute(path).parent_path() : path;
  std::vector<fs::path> files;
  fs::path              last = folder;
  std::error_code       error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    last = entry->path();
    std::error_code unknown;
    const bool      isFile = entry->is_regular_file(unknown);
    if (unknown && unknown != std::errc::no_such_file_or_directory) // as where a link leads nowhere
    {
      error = unknown;
      break;
    }
    if (isFile)
    {
      files.push_back(last);
    }
    else if (last.filename() == "lost+found")
    {
      entry.disable_recursion_pending(); // the file system's own, which users may not enter
    }
  }
  if (error)
  {
    throw std::runtime_error("cannot read " + last.string() + ": " + error.message() +
                             "; it may hold slices: make it readable, or move it out of the folder that is searched");
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string
Describe(const DicomSeries & series)
{
  const DicomHeader & first = series.Headers.front();
  return (first.Description.empty() ? "" : "\"" + first.Description + "\" ") + first.Modality + " " +
         std::to_string(series.GetNumberOfFrames()) + " x " + std::to_string(first.Columns) + " x " +
         std::to_string(first.Rows) + ", " + first.SeriesUid;
}

/** All series in a line, or the first of them. */
std::string
DescribeAll(const std::vector<DicomSeries> & all)
{
  constexpr std::size_t most = 20;
  std::string           text;
  for (std::size_t i = 0; i < all.size() && i < most; ++i)
  {
    text += (i == 0 ? "" : "; ") + std::to_string(i + 1) + ": " + Describe(all[i]);
  }
  return text + (all.size() > most ? "; and " + std::to_string(all.size() - most) + " more" : "");
}

bool
IsNumber(const std::string & text)
{
  return !text.empty() && text.size() < 7 &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}
} // namespace

std::size_t
DicomSeries::GetNumberOfFrames() const
{
  std::size_t number = 0;
  for (const DicomHeader & header : Headers)
  {
    number += header.Frames.size();
  }
  return number;
}

std::vector<DicomSeries>
FindDicomSeries(const std::string & path)
{
  const WatchedOpening               opening(path);
  std::map<std::string, DicomSeries> byUid;
  for (const fs::path & file : FindFiles(path))
  {
    WatchedOpening::Step(file);
    if (auto header = ReadDicomHeader(file))
    {
      byUid[header->SeriesUid].Headers.push_back(std::move(*header));
    }
  }
  std::vector<DicomSeries> all;
  for (auto & [uid, series] : byUid)
  {
    all.push_back(std::move(series));
  }
  std::stable_sort(all.begin(), all.end(), [](const DicomSeries & a, const DicomSeries & b) {
    return a.Headers.front().SeriesNumber < b.Headers.front().SeriesNumber;
  });
  return all;
}

DicomSeries
ChooseDicomSeries(const std::string & path, std::vector<DicomSeries> all, const std::string & wanted)
{
  const std::string start = "cannot read " + path + ": ";
  if (all.empty())
  {
    throw std::runtime_error(start + "it holds no DICOM series with images, and no slices as TIFF, PNG, BMP or JPEG; a "
                                     "volume in one file is given by its own name");
  }
  if (wanted.empty())
  {
    if (all.size() > 1)
    {
      throw std::runtime_error(
        start + "it holds several DICOM series; choose one with --series, by number or UID: " + DescribeAll(all));
    }
    return std::move(all.front());
  }
  const std::size_t number = IsNumber(wanted) ? std::stoul(wanted) : 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (i + 1 == number || all[i].Headers.front().SeriesUid == wanted)
    {
      return std::move(all[i]);
    }
  }
  throw std::runtime_error(start + "there is no DICOM series " + wanted + " among those it holds: " + DescribeAll(all));
}
