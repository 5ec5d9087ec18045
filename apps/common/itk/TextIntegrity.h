// SPDX-License-Identifier: Apache-2.0
#ifndef TextIntegrity_h
#define TextIntegrity_h

#include "itkImageIOBase.h"

#include <string>

/** Counts the numbers of a file that holds its voxels as text.
 * \throw std::runtime_error if there are fewer than the image has */
void
CheckTextIsWhole(const std::string & path, const itk::ImageIOBase & imageIO);

#endif
