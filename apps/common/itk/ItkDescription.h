// SPDX-License-Identifier: Apache-2.0
#ifndef ItkDescription_h
#define ItkDescription_h

#include "volumes/ImageDescription.h"

#include "itkImageIOBase.h"

#include <string>

/** The image of a file whose header ITK has read, in millimetres.
 * \throw std::runtime_error if it is none that can be subdivided */
ImageDescription
DescribeByItk(const std::string & path, const itk::ImageIOBase & imageIO);

#endif
