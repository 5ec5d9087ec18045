// SPDX-License-Identifier: Apache-2.0
#ifndef ItkDescription_h
#define ItkDescription_h

#include "volumes/ImageDescription.h"

#include "itkImageIOBase.h"

#include <string>

/** The image of a file whose header ITK has read, in millimetres. Where it has fewer axes than their directions have
 * coordinates, and these do not lie among the first, it has no placement, and a warning says so.
 * \throw std::runtime_error if it is none that can be subdivided */
ImageDescription
DescribeByItk(const std::string & path, const itk::ImageIOBase & imageIO, const WarningSink & warn);

#endif
