// SPDX-License-Identifier: Apache-2.0
#ifndef NiftiReader_h
#define NiftiReader_h

#include "nifti/NiftiFiles.h"
#include "nifti/NiftiHeader.h"
#include "volumes/VolumeReader.h"

#include <memory>

/** Opens a NIfTI or Analyze file whose voxels stand in it uncompressed, so that any part is read without the rest. The
 * voxels are those that ITK reads of it, but for slopes and intercepts so small that ITK takes them for none.
 * \param files that of the header and that of the voxels, which may be one
 * \param description the image as ITK describes it
 * \return nullptr if the voxels are stored in a way that only ITK reads */
std::unique_ptr<VolumeReader>
OpenPlainNifti(const NiftiHeader & header, const NiftiPair & files, const ImageDescription & description);

#endif
