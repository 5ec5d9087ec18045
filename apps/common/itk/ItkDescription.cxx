// SPDX-License-Identifier: Apache-2.0
#include "itk/ItkDescription.h"
#include "itk/PixelComponent.h"
#include "nifti/NiftiHeader.h"
#include "volumes/DescriptionCheck.h"

#include "itkMetaDataObject.h"
#include "itkVersion.h"

#include <cmath>
#include <map>
#include <string>

namespace
{
/** The formats' own names for themselves are their classes'. */
std::string
GetFormatName(const itk::ImageIOBase & imageIO)
{
  const std::string name = imageIO.GetNameOfClass();
  const std::string suffix = "ImageIO";
  const auto        end = name.rfind(suffix);
  const std::string format = end == std::string::npos ? name : name.substr(0, end);
  return format == "Nifti" ? "NIfTI" : format == "Nrrd" ? "NRRD" : format;
}

VoxelKind
GetKind(const itk::ImageIOBase & imageIO)
{
  switch (imageIO.GetPixelType())
  {
    case itk::IOPixelEnum::RGB:
      return VoxelKind::Rgb;
    case itk::IOPixelEnum::RGBA:
      return VoxelKind::Rgba;
    case itk::IOPixelEnum::COMPLEX:
      return VoxelKind::Complex;
    case itk::IOPixelEnum::SYMMETRICSECONDRANKTENSOR:
    case itk::IOPixelEnum::DIFFUSIONTENSOR3D:
      return VoxelKind::SymmetricTensor;
    default:
      return imageIO.GetNumberOfComponents() == 1 ? VoxelKind::Scalar : VoxelKind::Vector;
  }
}

std::map<std::string, std::string>
GetMetadata(const itk::MetaDataDictionary & dictionary)
{
  std::map<std::string, std::string> metadata;
  for (const std::string & key : dictionary.GetKeys())
  {
    std::string value;
    if (itk::ExposeMetaData<std::string>(dictionary, key, value))
    {
      metadata[key] = value;
    }
  }
  return metadata;
}

/** Takes from directions the coordinates of axes that an image does not have.
 * \return whether they were others than 0 */
bool
LeaveOutCoordinates(ImageGrid & grid)
{
  constexpr double rounding = 1e-4;
  bool             leavesAxes = false;
  for (std::vector<double> & direction : grid.Directions)
  {
    for (std::size_t row = grid.Size.size(); row < direction.size(); ++row)
    {
      leavesAxes = leavesAxes || !(std::abs(direction[row]) <= rounding);
    }
    direction.resize(grid.Size.size());
  }
  return leavesAxes;
}

void
LeaveOutPlacement(ImageGrid & grid)
{
  const std::size_t axes = grid.Size.size();
  for (std::size_t axis = 0; axis < axes; ++axis)
  {
    grid.Origin[axis] = 0.0;
    grid.Directions[axis].assign(axes, 0.0);
    grid.Directions[axis][axis] = 1.0;
  }
}

/** Before version 5.4, ITK's reader of NIfTI puts the spacing in space alone into millimetres. */
void
CompleteUnits(const std::string & path, const itk::ImageIOBase & imageIO, ImageGrid & grid)
{
  constexpr bool isRestLeft = ITK_VERSION_MAJOR < 5 || (ITK_VERSION_MAJOR == 5 && ITK_VERSION_MINOR < 4);
  if (isRestLeft && std::string(imageIO.GetNameOfClass()) == "NiftiImageIO")
  {
    ReadNiftiHeader(path).CompleteUnits(grid);
  }
}
} // namespace

ImageDescription
DescribeByItk(const std::string & path, const itk::ImageIOBase & imageIO, const WarningSink & warn)
{
  ImageDescription description;
  for (unsigned int axis = 0; axis < imageIO.GetNumberOfDimensions(); ++axis)
  {
    description.Grid.Size.push_back(imageIO.GetDimensions(axis));
    description.Grid.Spacing.push_back(imageIO.GetSpacing(axis));
    description.Grid.Origin.push_back(imageIO.GetOrigin(axis));
    description.Grid.Directions.push_back(imageIO.GetDirection(axis));
  }
  description.Component = WithComponentType(
    imageIO.GetComponentType(), [](auto value) { return itk::Subdivision::ElementTypeOf<decltype(value)>(); });
  description.NumberOfComponents = imageIO.GetNumberOfComponents();
  description.Kind = GetKind(imageIO);
  description.Format = GetFormatName(imageIO);
  description.Metadata = GetMetadata(imageIO.GetMetaDataDictionary());
  const std::size_t axes = description.Grid.Size.size();
  const bool        leavesAxes = LeaveOutCoordinates(description.Grid);
  if (leavesAxes || (description.Format == "NIfTI" && ReadNiftiHeader(path).GetPlacement().LeavesAxes(axes)))
  {
    LeaveOutPlacement(description.Grid);
    warn(path + " is placed in space, where an image of " + std::to_string(axes) + (axes == 1 ? " axis" : " axes") +
         " cannot be: its origin and directions are left out");
  }
  CheckDescription(path, description);
  CompleteUnits(path, imageIO, description.Grid);
  return description;
}
