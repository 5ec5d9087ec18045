// SPDX-License-Identifier: Apache-2.0
#include "formats/OpenVolume.h"
#include "dicom/Dicom.h"
#include "formats/Formats.h"
#include "plain/RawReader.h"
#include "slices/SliceFolder.h"
#include "system/files/RegularInput.h"
#include "text/HeaderText.h"
#include "tiff/TiffReader.h"

#include <filesystem>
#include <set>

namespace
{
/** What of an input its kind lets the user choose. */
struct Choices
{
  bool Series = false;
  bool Channel = false;
  bool Frame = false;
};

constexpr Choices NoChoices;
constexpr Choices TiffChoices = { false, true, true };
constexpr Choices DicomChoices = { true, false, true };

/** A choice that an input does not offer is not passed over. */
void
RefuseOtherChoices(const std::string & path, const InputOptions & options, const Choices & offered)
{
  if (!offered.Series && !options.Series.empty())
  {
    FailToRead(path, "--series chooses among the DICOM series of a folder, and it is none");
  }
  if (!offered.Channel && options.Channel)
  {
    FailToRead(path, "--channel chooses among the channels of a TIFF file, and it is none");
  }
  if (!offered.Frame && options.Frame)
  {
    FailToRead(
      path,
      "--frame chooses among the frames of a TIFF file or the images at one position of a DICOM series, and it "
      "is neither");
  }
}

/** Files of an older kind do not say in their first bytes that they are DICOM. */
bool
HasDicomEnding(const std::string & path)
{
  const std::string name = ToLower(path);
  return HasEnding(name, ".dcm") || HasEnding(name, ".dicom") || HasEnding(name, ".ima");
}

std::unique_ptr<VolumeReader>
OpenFolder(const std::string & path, const InputOptions & options, const WarningSink & warn)
{
  if (!HoldsSlices(path))
  {
    RefuseOtherChoices(path, options, DicomChoices);
    return OpenDicom(path, options, warn);
  }
  std::error_code                 error;
  std::set<std::filesystem::path> files; // in an order that does not depend on the file system
  for (const auto & entry : std::filesystem::directory_iterator(path, error))
  {
    files.insert(entry.path());
  }
  for (const std::filesystem::path & file : files)
  {
    if (FindVolumeFormat(file.string()) == nullptr && std::filesystem::is_regular_file(file, error) &&
        IsDicomFile(file.string()))
    {
      FailToRead(path,
                 "it holds both DICOM files, such as " + file.filename().string() +
                   ", and pictures; put those that make the volume into a folder of their own");
    }
  }
  RefuseOtherChoices(path, options, NoChoices);
  return OpenSliceFolder(path, options, warn);
}

std::unique_ptr<VolumeReader>
OpenAny(const std::string & path, const InputOptions & options, const WarningSink & warn)
{
  if (options.Raw)
  {
    RefuseOtherChoices(path, options, NoChoices);
    return OpenRaw(path, options, warn);
  }
  if (std::filesystem::is_directory(path))
  {
    return OpenFolder(path, options, warn);
  }
  if (IsDicomFile(path) || HasDicomEnding(path))
  {
    RefuseOtherChoices(path, options, DicomChoices);
    return OpenDicom(path, options, warn);
  }
  const VolumeFormat * const format = FindVolumeFormat(path);
  if (format != nullptr && format->Reader == OpenTiff)
  {
    RefuseOtherChoices(path, options, TiffChoices);
    return OpenTiff(path, options, warn);
  }
  RefuseOtherChoices(path, options, NoChoices);
  return format != nullptr && format->Reader != nullptr ? format->Reader(path, options, warn)
                                                        : OpenByItk(path, options, warn);
}
} // namespace

std::unique_ptr<VolumeReader>
OpenVolume(const std::string & path, const InputOptions & options, const WarningSink & warn)
{
  CheckIsRegularInput(path);
  auto reader = OpenAny(path, options, warn);
  reader->OverrideGrid(path, options, warn);
  return reader;
}
