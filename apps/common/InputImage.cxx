// SPDX-License-Identifier: Apache-2.0
#include "InputImage.h"
#include "FileIntegrity.h"
#include "RegularInput.h"

#include "itkImageFileReader.h" // registers the formats

#ifdef APPS_HAVE_GDCM
#  include "itkGDCMImageIO.h"
#  include "itkGDCMSeriesFileNames.h"
#endif

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <unistd.h>

namespace
{
[[noreturn]] void
Fail(const std::string & path, const std::string & reason)
{
  throw std::runtime_error("cannot read " + path + ": " + reason);
}

#ifdef APPS_HAVE_GDCM
std::string
Join(const std::vector<std::string> & words)
{
  std::string text;
  for (const std::string & word : words)
  {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

InputImage
FindSeries(const std::string & folder, const std::string & series)
{
  const auto names = itk::GDCMSeriesFileNames::New();
  names->SetUseSeriesDetails(false);
  names->SetDirectory(folder);
  const std::vector<std::string> all = names->GetSeriesUIDs();
  if (all.empty())
  {
    Fail(folder, "the folder holds no DICOM series");
  }
  if (series.empty() && all.size() > 1)
  {
    Fail(folder, "the folder holds several DICOM series; choose one with --series: " + Join(all));
  }
  InputImage input;
  input.FileNames = names->GetFileNames(series.empty() ? all.front() : series);
  if (input.FileNames.empty())
  {
    Fail(folder, "there is no DICOM series " + series + " but " + Join(all));
  }
  input.ImageIO = itk::GDCMImageIO::New();
  return input;
}
#else
InputImage
FindSeries(const std::string & folder, const std::string &)
{
  Fail(folder, "it is a folder, and this program was built without DICOM");
}
#endif

InputImage
FindFile(const std::string & path)
{
  if (access(path.c_str(), R_OK) != 0)
  {
    Fail(path, std::strerror(errno));
  }
  InputImage input;
  input.FileNames = { path };
  input.ImageIO = itk::ImageIOFactory::CreateImageIO(path.c_str(), itk::IOFileModeEnum::ReadMode);
  if (input.ImageIO.IsNull())
  {
    Fail(path, "it is in none of the known image formats");
  }
  return input;
}

void
CheckSizes(const std::string & path, const InputImage & input)
{
  if (input.Dimension < 1 || input.Dimension > 4)
  {
    Fail(path, "it has " + std::to_string(input.Dimension) + " axes; up to 4 are supported");
  }
  // In real numbers first, since whole numbers overflow silently.
  double bytes = static_cast<double>(GetPixelComponentSize(input.Component)) * input.NumberOfComponents;
  for (unsigned int axis = 0; axis < input.Dimension; ++axis)
  {
    bytes *= static_cast<double>(input.ImageIO->GetDimensions(axis));
  }
  if (bytes == 0.0)
  {
    Fail(path, "the image is empty");
  }
  constexpr double largest = 1e18; // eight times as many bytes, and a few copies, still fit a 64-bit number
  if (bytes > largest / 100)
  {
    Fail(path, "an image that large cannot be processed");
  }
}
} // namespace

InputImage
OpenInput(const std::string & path, const std::string & series)
{
  CheckIsRegularInput(path);
  std::error_code error;
  const bool      isFolder = std::filesystem::is_directory(path, error);
  InputImage      input = isFolder ? FindSeries(path, series) : FindFile(path);
  input.ImageIO->SetFileName(input.FileNames.front());
  input.ImageIO->ReadImageInformation();
  input.Dimension = input.ImageIO->GetNumberOfDimensions();
  input.NumberOfComponents = input.ImageIO->GetNumberOfComponents();
  input.Component = input.ImageIO->GetComponentType();
  input.CanStream = isFolder || input.ImageIO->CanStreamRead();
  CheckSizes(path, input);
  if (!isFolder)
  {
    CheckFileIsWhole(path, *input.ImageIO);
  }
  return input;
}
