// SPDX-License-Identifier: Apache-2.0
#ifndef Terminal_h
#define Terminal_h

#include <cstdio>
#include <string>

/** Where the program tells the user of errors and progress: stderr, even while it is kept from the libraries
 * (LibraryMessages.h). */
std::FILE *
GetTerminal();

/** Whether that is a terminal, and no file or pipe. */
bool
IsSeenByUser();

/** Prints a line there that starts with the program's name. */
void
TellUser(const std::string & line);

#endif
