// SPDX-License-Identifier: Apache-2.0
#include "formats/Formats.h"
#include "dicom/Dicom.h"
#include "text/HeaderText.h"
#include "system/InputFile.h"
#include "itk/ItkReader.h"
#include "itk/ItkWriter.h"
#include "nifti/NiftiFiles.h"
#include "nifti/NiftiHeader.h"
#include "plain/PlainReader.h"
#include "plain/PlainWriter.h"
#include "plain/RawReader.h"
#include "system/RegularInput.h"
#include "slices/SliceFolder.h"
#include "slices/SliceFolderWriter.h"
#include "tiff/TiffReader.h"
#include "tiff/TiffWriter.h"

#include <filesystem>
#include <set>
#include <stdexcept>

namespace
{
/** Opens a file by its own reader where that understands all of it, else by ITK's. */
template <std::unique_ptr<VolumeReader> (*VOpen)(const std::string &)>
std::unique_ptr<VolumeReader>
OpenPlain(const std::string & path, const InputOptions &, const WarningSink &)
{
  try
  {
    return VOpen(path);
  }
  catch (const HeaderNotUnderstood &)
  {
    return std::make_unique<ItkReader>(path);
  }
}

std::unique_ptr<VolumeReader>
OpenByItk(const std::string & path, const InputOptions &, const WarningSink &)
{
  return std::make_unique<ItkReader>(path);
}

std::unique_ptr<VolumeReader>
OpenNifti(const std::string & path, const InputOptions &, const WarningSink & warn)
{
  auto              reader = std::make_unique<ItkReader>(path);
  const NiftiHeader header(IsNiftiPair(path) ? FindNiftiPair(path).Header : path);
  if (header.IsPlacedTwice())
  {
    warn(path + " has two placements that differ, a qform and a sform: the " +
         header.GetPlacement(reader->GetDescription().Grid) + " is taken");
  }
  return reader;
}

template <typename TWriter>
std::unique_ptr<VolumeWriter>
Create(const std::string & path, const OutputOptions & options, const WarningSink & warn)
{
  return std::make_unique<TWriter>(path, options, warn);
}

bool
HasEnding(const std::string & name, const std::string & ending)
{
  return name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}
} // namespace

const std::vector<VolumeFormat> &
GetVolumeFormats()
{
  static const std::vector<VolumeFormat> formats = {
    { "MetaImage", { ".mha", ".mhd" }, OpenPlain<OpenMetaImage>, Create<PlainWriter>, true, true, true },
    { "NRRD", { ".nrrd", ".nhdr" }, OpenPlain<OpenNrrd>, Create<PlainWriter>, true, true, true },
    { "NIfTI", { ".nii", ".nii.gz", ".hdr", ".img", ".img.gz" }, OpenNifti, Create<ItkWriter>, true, false, true },
    { "VTK", { ".vtk" }, OpenByItk, Create<ItkWriter>, true, false, false },
    { "HDF5", { ".h5", ".hdf5", ".hdf", ".he5" }, OpenByItk, Create<ItkWriter>, true, false, true },
    { "GIPL", { ".gipl", ".gipl.gz" }, OpenByItk, Create<ItkWriter>, false, false, true },
    { "MRC", { ".mrc", ".rec" }, OpenByItk, Create<ItkWriter>, true, false, false },
    { "MINC", { ".mnc" }, OpenByItk, Create<ItkWriter>, false, false, true },
    { "PNG", { ".png" }, OpenByItk, Create<ItkWriter>, false, false, true },
    { "JPEG", { ".jpg", ".jpeg" }, OpenByItk, Create<ItkWriter>, false, false, true },
    { "BMP", { ".bmp" }, OpenByItk, Create<ItkWriter>, false, false, false },
    { "TIFF", { ".tif", ".tiff" }, OpenTiff, CreateTiff, true, true, true },
  };
  return formats;
}

const VolumeFormat *
FindVolumeFormat(const std::string & path)
{
  const std::string name = ToLower(std::filesystem::path(path).filename().string());
  for (const VolumeFormat & format : GetVolumeFormats())
  {
    for (const char * const ending : format.Endings)
    {
      if (HasEnding(name, ending))
      {
        return &format;
      }
    }
  }
  return nullptr;
}

namespace
{
/** A choice that a file does not offer is not passed over. */
void
RefuseChoices(const std::string & path, const InputOptions & options)
{
  if (!options.Series.empty())
  {
    FailToRead(path, "--series chooses among the DICOM series of a folder, and it is none");
  }
  if (options.Channel || options.Frame)
  {
    FailToRead(path, "--channel and --frame choose among the pages of TIFF files and the images of DICOM series");
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
  return OpenSliceFolder(path, options, warn);
}

std::unique_ptr<VolumeReader>
OpenAny(const std::string & path, const InputOptions & options, const WarningSink & warn)
{
  if (options.Raw)
  {
    return OpenRaw(path, options, warn);
  }
  if (std::filesystem::is_directory(path))
  {
    return OpenFolder(path, options, warn);
  }
  if (IsDicomFile(path) || HasDicomEnding(path))
  {
    return OpenDicom(path, options, warn);
  }
  const VolumeFormat * const format = FindVolumeFormat(path);
  if (format != nullptr && format->Reader == OpenTiff)
  {
    return OpenTiff(path, options, warn);
  }
  RefuseChoices(path, options);
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

std::unique_ptr<VolumeWriter>
CreateVolume(const std::string & path, const OutputOptions & options, const WarningSink & warn)
{
  std::error_code            error;
  const VolumeFormat * const format = FindVolumeFormat(path);
  if (path.back() == '/' || (format == nullptr && std::filesystem::is_directory(path, error)))
  {
    return CreateSliceFolder(path, options, warn);
  }
  if (HasEnding(ToLower(path), ".dcm"))
  {
    RefuseDicomOutput(path);
  }
  if (format != nullptr && format->Writer != nullptr)
  {
    return format->Writer(path, options, warn);
  }
  std::string endings;
  for (const VolumeFormat & known : GetVolumeFormats())
  {
    for (const char * const ending : known.Endings)
    {
      endings += known.Writer != nullptr ? (endings.empty() ? "" : " ") + std::string(ending) : "";
    }
  }
  throw std::runtime_error("cannot write " + path + ": no known image format has its ending; the known ones are " +
                           endings);
}
