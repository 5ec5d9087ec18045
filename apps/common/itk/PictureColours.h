// SPDX-License-Identifier: Apache-2.0
#ifndef PictureColours_h
#define PictureColours_h

#include "itkImageIOBase.h"

#include <string>

/** Why the colours of a picture whose header was read are not those that ITK would give; empty if they are. */
std::string
FindColourFault(const itk::ImageIOBase & imageIO);

#endif
