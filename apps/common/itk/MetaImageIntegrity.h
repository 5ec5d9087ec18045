// SPDX-License-Identifier: Apache-2.0
#ifndef MetaImageIntegrity_h
#define MetaImageIntegrity_h

#include "itkImageIOBase.h"

#include <string>

/** CheckFileIsWhole() for a MetaImage, its data in the same file or in another. MetaIO says nothing of compressed data
 * that break off or are damaged.
 * \param imageIO an itk::MetaImageIO
 * \throw std::runtime_error */
void
CheckMetaImageIsWhole(const std::string & path, itk::ImageIOBase & imageIO);

#endif
