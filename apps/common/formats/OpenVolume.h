// SPDX-License-Identifier: Apache-2.0
#ifndef OpenVolume_h
#define OpenVolume_h

#include "volumes/VolumeReader.h"

#include <memory>
#include <string>

/** Opens an image file, a folder of slices or of a DICOM series, or a raw file, and checks that it is whole and that
 * the volume is regular.
 * \throw std::runtime_error that says why not, in one sentence that names the file */
std::unique_ptr<VolumeReader>
OpenVolume(const std::string & path, const InputOptions & options, const WarningSink & warn);

#endif
