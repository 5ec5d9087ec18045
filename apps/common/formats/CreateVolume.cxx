// SPDX-License-Identifier: Apache-2.0
#include "formats/CreateVolume.h"
#include "dicom/Dicom.h"
#include "formats/Formats.h"
#include "slices/SliceFolderWriter.h"
#include "text/HeaderText.h"

#include <filesystem>
#include <stdexcept>

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
