// SPDX-License-Identifier: Apache-2.0
#ifndef GridOverrides_h
#define GridOverrides_h

#include "volumes/VolumeReader.h"

/** Puts the spacing and the origin that the user names in the place of a file's, and says so where the file had other
 * ones. One spacing stands for all axes.
 * \param saysSpacing whether the file says the spacing that stands there: what was only assumed is replaced silently
 * \throw std::runtime_error if there is not one number for each axis, or it is no distance or place */
void
ApplyOverrides(ImageDescription &   description,
               const InputOptions & options,
               const WarningSink &  warn,
               bool                 saysSpacing = true);

#endif
