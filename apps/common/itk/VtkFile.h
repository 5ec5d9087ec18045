// SPDX-License-Identifier: Apache-2.0
#ifndef VtkFile_h
#define VtkFile_h

#include "volumes/ImageDescription.h"

#include "itkImageIOBase.h"

#include <string>
#include <vector>

/** Checks that a VTK file holds as many voxels as its header says, and after them nothing but what such a file may have
 * there. Voxels as text are left to ReadVtkText().
 * \param imageIO has read the header
 * \throw std::runtime_error */
void
CheckVtk(const std::string & path, itk::ImageIOBase & imageIO);

bool
IsVtkText(const itk::ImageIOBase & imageIO);

/** Reads the voxels of a VTK file of text. ITK's reader would take numbers that the type cannot hold for others.
 * \throw std::runtime_error if they are not exactly those of the image */
std::vector<char>
ReadVtkText(const std::string & path, const ImageDescription & description);

#endif
