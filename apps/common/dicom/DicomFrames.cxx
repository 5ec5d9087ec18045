// SPDX-License-Identifier: Apache-2.0
#include "dicom/DicomFrames.h"
#include "dicom/DicomTags.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace
{
using Tag = gdcm::Tag;

template <std::size_t Size>
std::optional<std::array<double, Size>>
GetArray(const gdcm::DataSet & data, const Tag & tag)
{
  const std::vector<double> numbers = GetDicomNumbers(data, tag);
  if (numbers.size() != Size)
  {
    return std::nullopt;
  }
  std::array<double, Size> array = {};
  std::copy(numbers.begin(), numbers.end(), array.begin());
  return array;
}

/** Attributes as they stand in the file itself, or in an item that a frame or all frames have for them. */
void
ReadFrame(const gdcm::DataSet & data, DicomFrame & frame)
{
  if (const auto position = GetArray<3>(data, Tag(0x0020, 0x0032)))
  {
    frame.Position = position;
  }
  if (const auto orientation = GetArray<6>(data, Tag(0x0020, 0x0037)))
  {
    frame.Orientation = orientation;
  }
  const auto slope = GetDicomNumber(data, Tag(0x0028, 0x1053));
  const auto intercept = GetDicomNumber(data, Tag(0x0028, 0x1052));
  frame.IsSlopeTold = frame.IsSlopeTold || slope;
  frame.IsInterceptTold = frame.IsInterceptTold || intercept;
  frame.Slope = slope.value_or(frame.Slope);
  frame.Intercept = intercept.value_or(frame.Intercept);
}

/** Distances as a data set tells them, each by several attributes. */
class Spacings
{
public:
  /** Takes what a data set tells, in the place of what was read before. */
  void
  Read(const gdcm::DataSet & data)
  {
    for (std::size_t i = 0; i < m_Pixel.size(); ++i)
    {
      const auto spacing = GetArray<2>(data, PixelTags[i]);
      m_Pixel[i] = spacing ? spacing : m_Pixel[i];
    }
    for (std::size_t i = 0; i < m_Slice.size(); ++i)
    {
      const auto spacing = GetDicomNumber(data, SliceTags[i]);
      m_Slice[i] = spacing ? spacing : m_Slice[i];
    }
  }

  /** Gives a frame those of the attributes that tell most, wherever they stood. */
  void
  CopyTo(DicomFrame & frame) const
  {
    const auto isTold = [](const auto & spacing) { return spacing.has_value(); };
    const auto pixel = std::find_if(m_Pixel.begin(), m_Pixel.end(), isTold);
    if (pixel != m_Pixel.end())
    {
      frame.PixelSpacing = { (**pixel)[1], (**pixel)[0] }; // DICOM gives the distance of the rows first
    }
    const auto slice = std::find_if(m_Slice.begin(), m_Slice.end(), isTold);
    if (slice != m_Slice.end())
    {
      frame.SliceSpacing = *slice;
    }
  }

private:
  /** At the patient where it is known, else at the detector: Pixel Spacing, Imager Pixel Spacing, Nominal Scanned Pixel
   * Spacing. */
  const std::array<Tag, 3> PixelTags = { Tag(0x0028, 0x0030), Tag(0x0018, 0x1164), Tag(0x0018, 0x2010) };
  /** Spacing Between Slices, else Slice Thickness. */
  const std::array<Tag, 2> SliceTags = { Tag(0x0018, 0x0088), Tag(0x0018, 0x0050) };

  std::array<std::optional<std::array<double, 2>>, 3> m_Pixel;
  std::array<std::optional<double>, 2>                m_Slice;
};

/** The items of "functional groups": what enhanced files say of a frame, or of all. */
void
ReadFunctionalGroups(const gdcm::DataSet & groups, DicomFrame & frame, Spacings & spacings)
{
  for (const Tag & tag : { Tag(0x0020, 0x9113), Tag(0x0020, 0x9116), Tag(0x0028, 0x9145) })
  {
    for (const gdcm::DataSet & item : GetDicomItems(groups, tag))
    {
      ReadFrame(item, frame);
    }
  }
  for (const gdcm::DataSet & item : GetDicomItems(groups, Tag(0x0028, 0x9110)))
  {
    spacings.Read(item);
  }
  for (const gdcm::DataSet & item : GetDicomItems(groups, Tag(0x0020, 0x9111)))
  {
    frame.PhaseKey.push_back(GetDicomLong(item, Tag(0x0020, 0x9128)).value_or(0));
    frame.PhaseKey.push_back(GetDicomShort(item, Tag(0x0020, 0x9156)).value_or(0));
  }
}

/** Whether functional groups say where a frame stands, or all of them. */
bool
HavePosition(const gdcm::DataSet & groups)
{
  return !GetDicomItems(groups, Tag(0x0020, 0x9113)).empty();
}

/** Numbers that tell phases, echoes and repeated acquisitions at one position apart, the most telling one first. */
std::vector<double>
ReadPhaseKey(const gdcm::DataSet & data)
{
  std::vector<double> key;
  for (const Tag & tag : { Tag(0x0020, 0x0100),
                           Tag(0x0018, 0x1060),
                           Tag(0x0018, 0x0086),
                           Tag(0x0020, 0x0012),
                           Tag(0x0008, 0x0032),
                           Tag(0x0020, 0x0013) })
  {
    key.push_back(GetDicomNumber(data, tag).value_or(0));
  }
  return key;
}

/** Frames that lie on a common normal, at distances from the first: doses, and nuclear medicine. */
void
PlaceFramesAlongNormal(const gdcm::DataSet & data, DicomHeader & header)
{
  std::vector<double> offsets = GetDicomNumbers(data, Tag(0x3004, 0x000c));
  const auto          spacing = GetDicomNumber(data, Tag(0x0018, 0x0088));
  if (offsets.empty() && spacing && !GetDicomItems(data, Tag(0x0054, 0x0022)).empty())
  {
    for (std::size_t i = 0; i < header.Frames.size(); ++i)
    {
      offsets.push_back(static_cast<double>(i) * *spacing);
    }
  }
  if (offsets.size() != header.Frames.size())
  {
    for (DicomFrame & frame : header.Frames)
    {
      frame.Position.reset(); // one position is not that of all
    }
    return;
  }
  for (std::size_t i = 0; i < offsets.size(); ++i)
  {
    DicomFrame & frame = header.Frames[i];
    if (frame.Position && frame.Orientation)
    {
      const auto & [a, b, c, d, e, f] = *frame.Orientation;
      const double distance = offsets[i] - offsets[0];
      (*frame.Position)[0] += distance * (b * f - c * e);
      (*frame.Position)[1] += distance * (c * d - a * f);
      (*frame.Position)[2] += distance * (a * e - b * d);
    }
  }
}

/** The functional groups of each frame; none, if the file has none. */
std::vector<gdcm::DataSet>
GetGroupsOfFrames(const gdcm::DataSet & data, std::size_t frames)
{
  std::vector<gdcm::DataSet> groups = GetDicomItems(data, Tag(0x5200, 0x9230));
  if (!groups.empty() && groups.size() != frames)
  {
    throw std::runtime_error("it has " + std::to_string(frames) + " frames, but tells of " +
                             std::to_string(groups.size()) + " what they are");
  }
  return groups;
}

std::size_t
GetNumberOfFrames(const gdcm::DataSet & data)
{
  const double number = GetDicomNumber(data, Tag(0x0028, 0x0008)).value_or(1);
  if (!(number >= 1 && number <= 1e6 && number == std::floor(number)))
  {
    throw std::runtime_error("its number of frames is " + GetDicomText(data, Tag(0x0028, 0x0008)));
  }
  return static_cast<std::size_t>(number);
}
} // namespace

void
ReadDicomFrames(const gdcm::DataSet & data, DicomHeader & header)
{
  DicomFrame common;
  Spacings   spacings;
  ReadFrame(data, common);
  spacings.Read(data);
  const auto doseScaling = GetDicomNumber(data, Tag(0x3004, 0x000e));
  common.IsSlopeTold = common.IsSlopeTold || doseScaling;
  common.Slope = doseScaling.value_or(common.Slope);
  for (const gdcm::DataSet & detector : GetDicomItems(data, Tag(0x0054, 0x0022)))
  {
    ReadFrame(detector, common);
  }
  common.PhaseKey = ReadPhaseKey(data);
  bool arePlaced = false;
  for (const gdcm::DataSet & shared : GetDicomItems(data, Tag(0x5200, 0x9229)))
  {
    ReadFunctionalGroups(shared, common, spacings);
    arePlaced = arePlaced || HavePosition(shared);
  }
  spacings.CopyTo(common);
  header.Frames.assign(GetNumberOfFrames(data), common);
  const std::vector<gdcm::DataSet> groups = GetGroupsOfFrames(data, header.Frames.size());
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    Spacings own = spacings;
    ReadFunctionalGroups(groups[i], header.Frames[i], own);
    own.CopyTo(header.Frames[i]);
  }
  for (std::size_t i = 0; i < header.Frames.size(); ++i)
  {
    header.Frames[i].PhaseKey.push_back(static_cast<double>(i));
  }
  arePlaced = arePlaced || std::any_of(groups.begin(), groups.end(), HavePosition);
  if (header.Frames.size() > 1 && !arePlaced)
  {
    PlaceFramesAlongNormal(data, header);
  }
}
