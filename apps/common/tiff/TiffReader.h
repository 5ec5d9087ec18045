// SPDX-License-Identifier: Apache-2.0
#ifndef TiffReader_h
#define TiffReader_h

#include "volumes/VolumeReader.h"

#include <memory>
#include <string>

/** Opens a TIFF file, whose pages are the slices of a volume; one page is an image of two axes. ImageJ's and OME's
 * descriptions say the spacing, and which pages are channels and frames: one of them is read.
 *
 * Bits are 0 and 255, half floats become float, grey values with 0 as white are turned round, so that 0 is black.
 * \throw std::runtime_error if the file is not whole, or its pixels cannot be given as they are */
std::unique_ptr<VolumeReader>
OpenTiff(const std::string & path, const InputOptions & options, const WarningSink & warn);

#endif
