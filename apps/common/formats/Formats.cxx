// SPDX-License-Identifier: Apache-2.0
#include "formats/Formats.h"
#include "itk/ItkNrrdReader.h"
#include "itk/ItkReader.h"
#include "itk/ItkWriter.h"
#include "itk/JpegOrientation.h"
#include "nifti/NiftiFiles.h"
#include "nifti/NiftiHeader.h"
#include "nifti/NiftiReader.h"
#include "plain/PlainReader.h"
#include "plain/PlainWriter.h"
#include "text/HeaderText.h"
#include "tiff/TiffReader.h"
#include "tiff/TiffWriter.h"

#include <cmath>
#include <filesystem>

namespace
{
std::unique_ptr<VolumeReader>
OpenMeta(const std::string & path, const InputOptions &, const WarningSink &)
{
  return OpenMetaImage(path);
}

/** By the own reader where that understands all of the header, else by ITK's. */
std::unique_ptr<VolumeReader>
OpenAnyNrrd(const std::string & path, const InputOptions &, const WarningSink &)
{
  try
  {
    return OpenNrrd(path);
  }
  catch (const HeaderNotUnderstood &)
  {
    const std::uint64_t      bytes = CheckNrrdNumbers(path);
    auto                     reader = std::make_unique<ItkNrrdReader>(path);
    const ImageDescription & description = reader->GetDescription();
    if (description.GetBytes() != bytes)
    {
      FailToRead(path, "a part of its voxels' components would be left out; save them as a vector");
    }
    return reader;
  }
}

/** But of one that is left out whole, which the description of the image tells. */
void
WarnOfPlacement(const std::string &    path,
                const NiftiPlacement & placement,
                const ImageGrid &      grid,
                const WarningSink &    warn)
{
  const std::size_t axes = grid.Size.size();
  if (placement.LeavesAxes(axes))
  {
    return;
  }
  if (placement.LiesBeside(axes))
  {
    warn(path + " is placed in space, where an image of " + std::to_string(axes) + (axes == 1 ? " axis" : " axes") +
         " cannot be: its position across " + (axes == 1 ? "that" : "those") + " is left out");
  }
  if (placement.IsTwice())
  {
    warn(path + " has two placements that differ, a qform and a sform: the " + placement.GetName(grid) + " is taken");
  }
}

std::unique_ptr<VolumeReader>
OpenJpeg(const std::string & path, const InputOptions & options, const WarningSink & warn)
{
  auto                reader = OpenByItk(path, options, warn);
  const std::uint16_t orientation = ReadJpegOrientation(path);
  if (orientation != 1)
  {
    warn(path + " asks to be shown turned or flipped (orientation " + std::to_string(orientation) +
         "): its rows are read as they are stored");
  }
  return reader;
}

std::unique_ptr<VolumeReader>
OpenNifti(const std::string & path, const InputOptions & options, const WarningSink & warn)
{
  auto              reader = OpenByItk(path, options, warn);
  const NiftiPair   files = IsNiftiPair(path) ? FindNiftiPair(path) : NiftiPair{ path, path };
  const NiftiHeader header(files.Header);
  WarnOfPlacement(path, header.GetPlacement(), reader->GetDescription().Grid, warn);
  const std::string spm = header.FindSpmParts();
  if (!spm.empty())
  {
    warn(path + " is an Analyze file with " + spm +
         " as SPM writes them, left out here; SPM saves it as NIfTI with them");
  }
  const auto rescaling = header.GetRescaling();
  if (rescaling && !(std::isfinite(rescaling->first) && std::isfinite(rescaling->second)))
  {
    FailToRead(path,
               "its slope or intercept (scl_slope, scl_inter) is not finite; set them to 1 and 0 if there is none");
  }
  auto plain = OpenPlainNifti(header, files, reader->GetDescription());
  if (plain == nullptr && rescaling && reader->GetDescription().NumberOfComponents > 1)
  {
    FailToRead(path,
               "its voxels have several components and a slope, which are read right where they are vectors in an "
               "uncompressed file; uncompress it, or apply the slope and set scl_slope to 1");
  }
  if (plain == nullptr && !header.IsRescaledByItk())
  {
    FailToRead(path,
               "its slope or intercept (scl_slope, scl_inter) is below 2.2e-16, which is read right in an uncompressed "
               "file alone; uncompress it");
  }
  return plain != nullptr ? std::move(plain) : std::move(reader);
}

template <typename TWriter>
std::unique_ptr<VolumeWriter>
Create(const std::string & path, const OutputOptions & options, const WarningSink & warn)
{
  return std::make_unique<TWriter>(path, options, warn);
}
} // namespace

const std::vector<VolumeFormat> &
GetVolumeFormats()
{
  static const std::vector<VolumeFormat> formats = {
    { "MetaImage", { ".mha", ".mhd" }, OpenMeta, Create<PlainWriter>, true, true, true },
    { "NRRD", { ".nrrd", ".nhdr" }, OpenAnyNrrd, Create<PlainWriter>, true, true, true },
    { "NIfTI", { ".nii", ".nii.gz", ".hdr", ".img", ".img.gz" }, OpenNifti, Create<ItkWriter>, true, false, true },
    { "VTK", { ".vtk" }, OpenByItk, Create<ItkWriter>, true, false, false },
    { "HDF5", { ".h5", ".hdf5", ".hdf", ".he5" }, OpenByItk, Create<ItkWriter>, true, false, true },
    { "GIPL", { ".gipl", ".gipl.gz" }, OpenByItk, Create<ItkWriter>, false, false, true },
    { "MRC", { ".mrc", ".rec" }, OpenByItk, Create<ItkWriter>, true, false, false },
    { "MINC", { ".mnc" }, OpenByItk, Create<ItkWriter>, false, false, true },
    { "PNG", { ".png" }, OpenByItk, Create<ItkWriter>, false, false, true },
    { "JPEG", { ".jpg", ".jpeg" }, OpenJpeg, Create<ItkWriter>, false, false, true },
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

std::unique_ptr<VolumeReader>
OpenByItk(const std::string & path, const InputOptions &, const WarningSink & warn)
{
  const VolumeFormat * const format = FindVolumeFormat(path);
  return std::make_unique<ItkReader>(path, format == nullptr ? "" : format->Name, warn);
}
