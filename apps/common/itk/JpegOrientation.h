// SPDX-License-Identifier: Apache-2.0
#ifndef JpegOrientation_h
#define JpegOrientation_h

#include <cstdint>
#include <string>

/** How a JPEG file asks to be shown, by its Exif data, as TIFF counts it: 1, which is as stored, to 8; 1 where it asks
 * for nothing, or is no JPEG file. */
std::uint16_t
ReadJpegOrientation(const std::string & path);

#endif
