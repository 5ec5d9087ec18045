// SPDX-License-Identifier: Apache-2.0
#ifndef Formats_h
#define Formats_h

#include <string>

/** Prints the image formats: their endings, and whether they are read, written, streamed and compressed. */
void
PrintFormats();

/** Prints the DICOM series of a folder. */
void
PrintSeries(const std::string & folder);

#endif
