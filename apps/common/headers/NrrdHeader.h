// SPDX-License-Identifier: Apache-2.0
#ifndef NrrdHeader_h
#define NrrdHeader_h

#include "headers/Metadata.h"
#include "headers/PlainLayout.h"

#include <string>

/** Reads the header of an NRRD (.nrrd, .nhdr) and finds its voxels.
 * \throw HeaderNotUnderstood if the image is none of those whose voxels simply stand in files
 * \throw std::runtime_error if the header or the files are not right */
PlainLayout
ReadNrrdHeader(const std::string & path);

/** What the header of an NRRD says of its image, where the components of a voxel are the first axis or the last.
 * \throw HeaderNotUnderstood if its axes are others
 * \throw std::runtime_error if it is not right */
ImageDescription
DescribeNrrd(const std::string & path);

/** Replaces the metadata of an image that ITK has described by what the header of its NRRD says besides the grid.
 * \throw std::runtime_error if ITK may have turned its grid wrongly */
void
ReplaceNrrdMetadata(const std::string & path, ImageDescription & description);

/** Finds the numbers of an NRRD of any kind, and says nothing of the grid but the sizes of all axes.
 * \throw std::runtime_error if the header or the files are not right */
PlainLayout
ReadNrrdNumbers(const std::string & path);

/** A whole header, the empty line at its end included.
 * \param dataFile the name of the data file; empty: the voxels follow the header */
std::string
ComposeNrrdHeader(const ImageDescription & description,
                  const OutputMetadata &   metadata,
                  const std::string &      dataFile,
                  bool                     isCompressed);

#endif
