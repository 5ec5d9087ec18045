// SPDX-License-Identifier: Apache-2.0
#ifndef LibraryWarnings_h
#define LibraryWarnings_h

#include <string>
#include <vector>

/** The warnings among what libraries printed: each once, in one line, without places in source code; of many, the first
 * few. */
std::vector<std::string>
FindLibraryWarnings(const std::string & text);

/** What libraries printed, without the lines that tell places in source code, as failed assertions do. */
std::string
RemoveSourceLines(const std::string & text);

#endif
