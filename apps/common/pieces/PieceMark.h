// SPDX-License-Identifier: Apache-2.0
#ifndef PieceMark_h
#define PieceMark_h

#include <filesystem>
#include <string>

// An output that was made in pieces remembers what they agreed on, in an extended attribute, where the file system has
// them: a piece that is run again afterwards finds that it is done. What changes the output makes the mark void.

void
MarkAsComplete(const std::filesystem::path & output, const std::string & agreement);

/** What the pieces of an output agreed on; empty if it is not known. */
std::string
ReadMark(const std::filesystem::path & output);

#endif
