// SPDX-License-Identifier: Apache-2.0
#ifndef LibraryReason_h
#define LibraryReason_h

#include <exception>
#include <string>

/** What an exception of ITK, or of a library behind it, says, less the places in the code that it names.
 * \param path of the file that it may name; empty for none */
std::string
GetReason(const std::exception & error, const std::string & path = {});

#endif
