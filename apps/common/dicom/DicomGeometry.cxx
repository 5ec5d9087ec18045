// SPDX-License-Identifier: Apache-2.0
#include "dicom/DicomGeometry.h"
#include "dicom/DicomPositions.h"
#include "volumes/NumberGaps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace
{
/** Splits slices into those that are alike, the most numerous first. */
template <typename TAlike>
std::vector<std::vector<DicomSlice>>
GroupSlices(const std::vector<DicomSlice> & slices, TAlike && areAlike)
{
  std::vector<std::vector<DicomSlice>> groups;
  for (const DicomSlice & slice : slices)
  {
    const auto group =
      std::find_if(groups.begin(), groups.end(), [&](const auto & other) { return areAlike(other.front(), slice); });
    group == groups.end() ? groups.push_back({ slice }) : group->push_back(slice);
  }
  std::stable_sort(groups.begin(), groups.end(), [](const auto & a, const auto & b) { return a.size() > b.size(); });
  return groups;
}

/** \throw std::runtime_error that names the slices that are not as most are */
template <typename TAlike>
void
CheckAllAlike(const std::vector<DicomSlice> & slices, const std::string & what, TAlike && areAlike)
{
  const auto groups = GroupSlices(slices, areAlike);
  if (groups.size() > 1)
  {
    std::vector<DicomSlice> odd;
    for (std::size_t i = 1; i < groups.size(); ++i)
    {
      odd.insert(odd.end(), groups[i].begin(), groups[i].end());
    }
    throw std::runtime_error("the series is no regular volume: " + std::to_string(odd.size()) + " of its " +
                             std::to_string(slices.size()) + " slices (" + NameSlices(odd) +
                             ") differ from the others in " + what +
                             "; if they do not belong to it (localizers, say), move them elsewhere");
  }
}

template <std::size_t Size>
bool
AreClose(const std::optional<std::array<double, Size>> & a,
         const std::optional<std::array<double, Size>> & b,
         double                                          tolerance)
{
  if (!a || !b)
  {
    return a.has_value() == b.has_value();
  }
  for (std::size_t i = 0; i < Size; ++i)
  {
    if (!(std::abs((*a)[i] - (*b)[i]) <= tolerance))
    {
      return false;
    }
  }
  return true;
}

/** Numbers that are stored alike would be values of other units where a slice lacks a slope or an intercept that is of
 * use in others. */
void
CheckRescaleIsTold(const std::vector<DicomSlice> & slices)
{
  const auto isAny = [&slices](auto && isSo) {
    return std::any_of(
      slices.begin(), slices.end(), [&isSo](const DicomSlice & slice) { return isSo(slice.GetFrame()); });
  };
  if (isAny([](const DicomFrame & frame) { return frame.Slope != 1; }))
  {
    CheckAllAlike(slices, "whether they tell a slope", [](const DicomSlice & a, const DicomSlice & b) {
      return a.GetFrame().IsSlopeTold == b.GetFrame().IsSlopeTold;
    });
  }
  if (isAny([](const DicomFrame & frame) { return frame.Intercept != 0; }))
  {
    CheckAllAlike(slices, "whether they tell an intercept", [](const DicomSlice & a, const DicomSlice & b) {
      return a.GetFrame().IsInterceptTold == b.GetFrame().IsInterceptTold;
    });
  }
}

void
CheckSlicesAreAlike(const std::vector<DicomSlice> & slices)
{
  CheckAllAlike(slices, "size", [](const DicomSlice & a, const DicomSlice & b) {
    return a.Header->Columns == b.Header->Columns && a.Header->Rows == b.Header->Rows;
  });
  CheckAllAlike(slices, "their kind of pixels", [](const DicomSlice & a, const DicomSlice & b) {
    return a.Header->Samples == b.Header->Samples && a.Header->Photometric == b.Header->Photometric;
  });
  constexpr double angle = 1e-4; // of direction cosines: 0.03 mm at the far end of a row of 300 mm
  CheckAllAlike(slices, "orientation", [](const DicomSlice & a, const DicomSlice & b) {
    return AreClose(a.GetFrame().Orientation, b.GetFrame().Orientation, angle);
  });
  CheckAllAlike(slices, "spacing of the pixels", [](const DicomSlice & a, const DicomSlice & b) {
    const auto & spacing = a.GetFrame().PixelSpacing;
    return AreClose(spacing, b.GetFrame().PixelSpacing, spacing ? 1e-4 * (*spacing)[0] : 0);
  });
  CheckRescaleIsTold(slices);
  CheckAllAlike(slices, "that they have no position", [](const DicomSlice & a, const DicomSlice & b) {
    return a.GetFrame().Position.has_value() == b.GetFrame().Position.has_value();
  });
}

/** Whether the order of slices that are sorted by their numbers is told: the files have different whole numbers, or are
 * one. */
bool
AreNumbered(const std::vector<DicomSlice> & slices)
{
  constexpr double largest = 1e15; // doubles count up to it
  const auto       isNumbered = [](const DicomSlice & slice) {
    const auto number = slice.Header->InstanceNumber;
    return number && std::abs(*number) <= largest && *number == std::floor(*number);
  };
  const auto areOfOneFile = [](const DicomSlice & a, const DicomSlice & b) { return a.Header == b.Header; };
  const auto areTwins = [&](const DicomSlice & a, const DicomSlice & b) {
    return !areOfOneFile(a, b) && a.Header->InstanceNumber == b.Header->InstanceNumber;
  };
  return std::adjacent_find(slices.begin(), slices.end(), std::not_fn(areOfOneFile)) == slices.end() ||
         (std::all_of(slices.begin(), slices.end(), isNumbered) &&
          std::adjacent_find(slices.begin(), slices.end(), areTwins) == slices.end());
}

void
WarnOfInstanceGaps(const std::vector<DicomSlice> & slices, const WarningSink & warn)
{
  std::vector<std::int64_t> numbers;
  for (std::size_t i = 0; i < slices.size(); ++i)
  {
    if (i == 0 || slices[i].Header != slices[i - 1].Header)
    {
      numbers.push_back(static_cast<std::int64_t>(slices[i].Header->InstanceNumber.value_or(0)));
    }
  }
  WarnOfNumberGaps("the DICOM series", numbers, warn);
}

/** Slices that bear no position: one is chosen, or all are stacked in the order of their numbers. */
std::vector<DicomSlice>
ArrangeWithoutPositions(std::vector<DicomSlice> slices, const InputOptions & options, const WarningSink & warn)
{
  const auto key = [](const DicomSlice & slice) {
    return std::make_pair(slice.Header->InstanceNumber.value_or(0), slice.Frame);
  };
  std::sort(slices.begin(), slices.end(), [&key](const auto & a, const auto & b) { return key(a) < key(b); });
  if (options.Frame)
  {
    if (*options.Frame >= slices.size())
    {
      throw std::runtime_error("there is no frame " + std::to_string(*options.Frame) + " among its " +
                               std::to_string(slices.size()) + ", counted from 0");
    }
    return { slices[*options.Frame] };
  }
  if (slices.size() == 1)
  {
    return slices;
  }
  const bool areNumbered = AreNumbered(slices);
  if (!options.Spacing || options.Spacing->size() < 3 || !areNumbered)
  {
    throw std::runtime_error(
      "its " + std::to_string(slices.size()) +
      " images bear no position; choose one with --frame, counted from 0, or have them stacked in "
      "the order of their numbers with --spacing X,Y,Z" +
      (areNumbered ? "" : ", which needs different instance numbers"));
  }
  warn("the DICOM images bear no position; they are stacked in the order of their numbers");
  WarnOfInstanceGaps(slices, warn);
  return slices;
}

/** Sets directions, from the cosines, which are made exact. */
void
SetDirections(const DicomSlice & slice, ImageGrid & grid, const WarningSink & warn)
{
  const auto & orientation = slice.GetFrame().Orientation;
  if (!orientation && slice.GetFrame().Position)
  {
    warn("the DICOM files do not tell the orientation of the slices; rows are taken to run along x, columns along y");
  }
  const auto axes = GetSliceAxes(slice);
  for (const auto & axis : axes)
  {
    grid.Directions.emplace_back(axis.begin(), axis.end());
  }
}

void
SetSpacingInPlane(const DicomFrame & frame, ImageGrid & grid, const WarningSink & warn)
{
  const auto & spacing = frame.PixelSpacing;
  if (!spacing)
  {
    warn("the DICOM files do not tell the spacing of the pixels; 1 is taken");
  }
  for (std::size_t axis = 0; axis < 2; ++axis)
  {
    const double value = spacing ? (*spacing)[axis] : 1;
    if (!(value > 0))
    {
      throw std::runtime_error("the spacing of its pixels is " + std::to_string(value));
    }
    grid.Spacing.push_back(value);
  }
}
} // namespace

DicomVolume
ArrangeDicomSlices(const DicomSeries & series, const InputOptions & options, const WarningSink & warn)
{
  DicomVolume volume;
  for (const DicomHeader & header : series.Headers)
  {
    for (std::size_t frame = 0; frame < header.Frames.size(); ++frame)
    {
      volume.Slices.push_back({ &header, frame });
    }
  }
  CheckSlicesAreAlike(volume.Slices);
  const DicomHeader & first = series.Headers.front();
  ImageGrid &         grid = volume.Grid;
  SetDirections(volume.Slices.front(), grid, warn);
  SetSpacingInPlane(volume.Slices.front().GetFrame(), grid, warn);
  const double pixel = std::min(grid.Spacing[0], grid.Spacing[1]);
  if (volume.Slices.front().GetFrame().Position)
  {
    volume.Slices = ChoosePhase(std::move(volume.Slices), pixel, options.Frame);
  }
  else
  {
    volume.Slices = ArrangeWithoutPositions(std::move(volume.Slices), options, warn);
  }
  const DicomFrame & bottom = volume.Slices.front().GetFrame();
  const double       told = std::abs(bottom.SliceSpacing.value_or(0));
  grid.Spacing.push_back(volume.Slices.size() > 1 && bottom.Position ? CheckPositions(volume.Slices, pixel)
                         : told > 0                                  ? told
                                                                     : 1);
  const auto origin = bottom.Position.value_or(std::array<double, 3>{});
  grid.Origin.assign(origin.begin(), origin.end());
  grid.Size = { first.Columns, first.Rows, volume.Slices.size() };
  return volume;
}
