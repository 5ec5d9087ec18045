// SPDX-License-Identifier: Apache-2.0
#ifndef VtkFile_h
#define VtkFile_h

#include "volumes/ImageDescription.h"

#include <string>
#include <vector>

// Of values beside those of the image, and of a position that the image does not have, both functions warn.

/** Checks that a binary VTK file holds as many voxels as the image has, and after them nothing but what such a file may
 * have there.
 * \param description the image as ITK describes it
 * \throw std::runtime_error */
void
CheckVtkVoxels(const std::string & path, const ImageDescription & description, const WarningSink & warn);

/** Reads the voxels of a VTK file of text. ITK's reader would take numbers that the type cannot hold for others.
 * \throw std::runtime_error if they are not exactly those of the image */
std::vector<char>
ReadVtkText(const std::string & path, const ImageDescription & description, const WarningSink & warn);

#endif
