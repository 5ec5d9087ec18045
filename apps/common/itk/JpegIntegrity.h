// SPDX-License-Identifier: Apache-2.0
#ifndef JpegIntegrity_h
#define JpegIntegrity_h

#include <string>

/** Decodes a JPEG file whole. ITK's reader takes grey for what cannot be decoded, without a word, and crashes on
 * headers that are damaged.
 * \return what is wrong with it; empty if nothing is, or if it does not begin as a JPEG file does */
std::string
FindJpegFault(const std::string & path);

#endif
