// SPDX-License-Identifier: Apache-2.0
#ifndef ItkNrrdReader_h
#define ItkNrrdReader_h

#include "itk/ItkReader.h"

/** Reads the numbers of an NRRD by ITK, which moves the components of voxels to the front. Of what its header says, ITK
 * leaves the measurement frame out, and up to version 5.2 turns left where anterior is meant: that is read here. */
class ItkNrrdReader : public ItkReader
{
public:
  /** \throw std::runtime_error that says why the file cannot be read, or is not whole */
  explicit ItkNrrdReader(const std::string & path);
};

#endif
