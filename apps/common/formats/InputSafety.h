// SPDX-License-Identifier: Apache-2.0
#ifndef InputSafety_h
#define InputSafety_h

#include "volumes/VolumeReader.h"
#include "volumes/VolumeWriter.h"

#include <string>

/** Whether an output may take the place of the file or the pair of files that it is made from: the voxels are all read
 * by then, unless several processes make it. */
enum class InPlace
{
  Allowed,
  Refused
};

/** Checks that an output leaves every file of its input, by whatever name or link, where it is.
 * \param writer was made for the output, and has not begun
 * \throw std::runtime_error */
void
CheckInputStays(const std::string &  input,
                const VolumeReader & reader,
                const std::string &  output,
                const VolumeWriter & writer,
                InPlace              inPlace);

#endif
