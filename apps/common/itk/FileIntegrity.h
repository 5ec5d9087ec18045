// SPDX-License-Identifier: Apache-2.0
#ifndef FileIntegrity_h
#define FileIntegrity_h

#include "itkImageIOBase.h"

#include <string>

/** Checks that a file holds as much data as its header says. The readers of several formats would go on without a word
 * and leave what is missing as it comes; MetaIO would tell of a short file only when it gets there.
 * VTK files are left to VtkFile.h.
 * \param imageIO has read the header
 * \throw std::exception */
void
CheckFileIsWhole(const std::string & path, itk::ImageIOBase & imageIO);

/** Checks what a library printed while it read a file, where that is the only sign that data is missing.
 * \throw std::runtime_error */
void
CheckMessages(const std::string & path, const std::string & messages);

#endif
