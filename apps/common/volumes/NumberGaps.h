// SPDX-License-Identifier: Apache-2.0
#ifndef NumberGaps_h
#define NumberGaps_h

#include "volumes/ImageDescription.h"

#include <cstdint>
#include <string>
#include <vector>

/** Warns where the numbers of slices, which grow, leave others out, or grow in steps of more than 1: the slices are
 * neighbours all the same.
 * \param owner what has the slices, in the words of a message */
void
WarnOfNumberGaps(const std::string & owner, const std::vector<std::int64_t> & numbers, const WarningSink & warn);

#endif
