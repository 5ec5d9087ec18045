// SPDX-License-Identifier: Apache-2.0
#ifndef InputImage_h
#define InputImage_h

#include "PixelComponent.h"

#include <string>
#include <vector>

/** What stands in the input, as its header tells: a file, or the slices of a DICOM series. */
struct InputImage
{
  std::vector<std::string>  FileNames;
  itk::ImageIOBase::Pointer ImageIO; // has read the header of the (first) file
  unsigned int              Dimension = 0;
  unsigned int              NumberOfComponents = 0;
  PixelComponent            Component = PixelComponent::UNKNOWNCOMPONENTTYPE;
  bool                      CanStream = false; // regions can be read without the rest
};

/** Opens an image file, or a folder with a DICOM series.
 * \param series the UID of the series to take; empty: the only one
 * \throw std::runtime_error that says why it cannot be read, or is not whole */
InputImage
OpenInput(const std::string & path, const std::string & series);

#endif
