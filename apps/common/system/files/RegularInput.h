// SPDX-License-Identifier: Apache-2.0
#ifndef RegularInput_h
#define RegularInput_h

#include <string>

/** Refuses what cannot be read twice or has no end: a named pipe, a socket, a device. Reading them would hang.
 * \throw std::runtime_error if it is neither a readable file nor a folder */
void
CheckIsRegularInput(const std::string & path);

#endif
