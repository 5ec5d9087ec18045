// SPDX-License-Identifier: Apache-2.0
#include "dicom/DicomCopies.h"
#include "dicom/DicomPixels.h"
#include "dicom/DicomValues.h"
#include "system/files/InputFile.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <tuple>

namespace
{
bool
HaveSameBytes(const DicomHeader & a, const DicomHeader & b)
{
  const InputFile first(a.FileName.string());
  const InputFile second(b.FileName.string());
  if (first.GetSize() != second.GetSize())
  {
    return false;
  }
  constexpr std::uint64_t part = 1 << 20;
  for (std::uint64_t place = 0; place < first.GetSize(); place += part)
  {
    const std::uint64_t bytes = std::min(part, first.GetSize() - place);
    if (first.ReadTextAt(place, bytes) != second.ReadTextAt(place, bytes))
    {
      return false;
    }
  }
  return true;
}

/** All that a frame says but what sorts phases: a copy may have another number. */
auto
GetPlaceAndValues(const DicomFrame & frame)
{
  return std::tie(
    frame.Position, frame.Orientation, frame.PixelSpacing, frame.SliceSpacing, frame.Slope, frame.Intercept);
}

/** What the stored pixels are. */
auto
GetKindOfPixels(const DicomHeader & header)
{
  return std::tie(header.Columns,
                  header.Rows,
                  header.Samples,
                  header.Photometric,
                  header.BitsAllocated,
                  header.BitsStored,
                  header.IsSigned,
                  header.HasValueTable);
}

void
CheckFile(const DicomHeader & header)
{
  try
  {
    CheckPixels(header);
  }
  catch (const std::runtime_error & error)
  {
    throw std::runtime_error("cannot read " + header.FileName.parent_path().string() + ": " + error.what());
  }
}

/** Whether two files hold one image, be they encoded in different ways, or the one without names. */
bool
HoldSameImage(const DicomHeader & a, const DicomHeader & b)
{
  const auto areAlike = [](const DicomFrame & one, const DicomFrame & other) {
    return GetPlaceAndValues(one) == GetPlaceAndValues(other);
  };
  if (GetKindOfPixels(a) != GetKindOfPixels(b) ||
      !std::equal(a.Frames.begin(), a.Frames.end(), b.Frames.begin(), b.Frames.end(), areAlike))
  {
    return false;
  }
  CheckFile(a);
  CheckFile(b);
  return DecodeDicomPixels(a) == DecodeDicomPixels(b);
}
} // namespace

void
LeaveOutCopies(DicomSeries & series, const WarningSink & warn)
{
  std::map<std::string, std::size_t> seen; // in kept
  std::vector<DicomHeader>           kept;
  for (DicomHeader & header : series.Headers)
  {
    const auto [first, isNew] = seen.emplace(header.InstanceUid, kept.size());
    if (isNew || header.InstanceUid.empty())
    {
      kept.push_back(std::move(header));
      continue;
    }
    const DicomHeader & other = kept[first->second];
    if (!HaveSameBytes(other, header) && !HoldSameImage(other, header))
    {
      throw std::runtime_error(
        "cannot read " + header.FileName.string() + ": it has the SOP instance UID " + header.InstanceUid + " of " +
        other.FileName.string() +
        ", but not the same image; move the one that does not belong to the volume elsewhere, or "
        "give each a UID of its own");
    }
    warn(header.FileName.string() + " is left out: it holds the same image as " + other.FileName.string());
  }
  series.Headers = std::move(kept);
}
