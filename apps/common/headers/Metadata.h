// SPDX-License-Identifier: Apache-2.0
#ifndef Metadata_h
#define Metadata_h

#include "volumes/ImageDescription.h"

#include <map>
#include <string>

/** Whose names and rules the metadata of an output follow. */
enum class MetadataStyle
{
  MetaImage,
  Nrrd,
  Other // ITK's dictionary
};

/** What of an input's metadata goes into an output. */
struct OutputMetadata
{
  std::map<std::string, std::string> Fields; // of the output's format: units, space, ...
  std::map<std::string, std::string> Keys;   // of no meaning to the format
};

/** Selects what stays true for another grid over the same space: units, the space, the modality, the names and numbers
 * of segments. What described the input's grid or file is dropped. All else, which may be about a patient, is dropped
 * unless \c keepAll; then keys that the output's format takes for fields of its own are renamed to Input_KEY. */
OutputMetadata
SelectMetadata(const ImageDescription & description, MetadataStyle style, bool keepAll);

/** Whether an image says that its voxels are labels: by the intent of NIfTI, by the name of 3D Slicer's segmentations
 * (.seg.nrrd), or by a segment that the header tells of. */
bool
IsLabelMap(const std::string & path, const ImageDescription & description);

/** Whether the components of an image, or its gradients, refer to a frame other than the space (NRRD's measurement
 * frame) that an output lacks: only NRRD holds it, and only with a vector for each axis. */
bool
LosesMeasurementFrame(const ImageDescription & input, bool isToNrrd);

/** The unit of an image's spacing and origin: mm, um, cm, m or another; empty if nothing says so. */
std::string
GetUnit(const ImageDescription & description);

#endif
