// SPDX-License-Identifier: Apache-2.0
#ifndef FormatLimits_h
#define FormatLimits_h

#include "volumes/ImageDescription.h"

#include "itkImageIOBase.h"

#include <string>

/** Checks what ITK's writers do not: that the sizes and the components of an image are such as its file's format holds.
 * \param path of the file, for messages
 * \param imageIO writes the format
 * \throw std::runtime_error if they are not, with the formats that do hold them */
void
CheckFormatLimits(const std::string & path, const ImageDescription & description, const itk::ImageIOBase & imageIO);

#endif
