// SPDX-License-Identifier: Apache-2.0
#ifndef WrittenImage_h
#define WrittenImage_h

#include "volumes/ImageDescription.h"

#include <string>
#include <vector>

/** Compares what was to be written with what is read back. */

/** What of an image's grid and kind is lost in another description of it, in words: "the spacing of the axis z". The
 * precision of single precision numbers is enough. Empty if nothing is. */
std::vector<std::string>
FindLosses(const ImageDescription & meant, const ImageDescription & found);

/** Whether both have the same voxels by number, type and components. */
bool
HaveSameVoxels(const ImageDescription & meant, const ImageDescription & found);

/** Whether the first, the last and some other rows of a file are those of an image in memory. */
bool
HasRows(const std::string & file, const ImageDescription & meant, const void * voxels);

#endif
