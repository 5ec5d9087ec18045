// SPDX-License-Identifier: Apache-2.0
#ifndef DescriptionCheck_h
#define DescriptionCheck_h

#include "volumes/ImageDescription.h"

#include <string>

/** Checks an image's size, and that its grid is one: the vectors of its axes are not in one plane. Spacings become
 * positive and directions unit vectors.
 * \throw std::runtime_error */
void
CheckDescription(const std::string & path, ImageDescription & description);

#endif
