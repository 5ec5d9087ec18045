// SPDX-License-Identifier: Apache-2.0
#ifndef FileIntegrity_h
#define FileIntegrity_h

#include "itkImageIOBase.h"

#include <string>

/** Checks that a MetaImage holds as much data as its header says; other formats are left to their own readers.
 * MetaIO would take what is missing from a compressed file for zeros, and would tell of a short uncompressed one only
 * when the program gets there.
 * \param imageIO has read the header
 * \throw std::runtime_error */
void
CheckFileIsWhole(const std::string & path, itk::ImageIOBase & imageIO);

#endif
