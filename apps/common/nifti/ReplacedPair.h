// SPDX-License-Identifier: Apache-2.0
#ifndef ReplacedPair_h
#define ReplacedPair_h

#include <string>

/** Other programs, too, call a header .hdr and its voxels .img: such a pair does not give way to one of NIfTI.
 * \throw std::runtime_error if an image written under the name would replace both files of it */
void
CheckReplacedPair(const std::string & path);

#endif
