// SPDX-License-Identifier: Apache-2.0
#ifndef NameExchange_h
#define NameExchange_h

#include <filesystem>
#include <system_error>

/** Exchanges the names of two files or folders in one step, where the system can do that. */
std::error_code
ExchangeNames(const std::filesystem::path & a, const std::filesystem::path & b);

/** Gives a file or folder another name.
 * \param exchanges whether what has that name gets the former one; else it must be a file, which is replaced */
std::error_code
GiveName(const std::filesystem::path & from, const std::filesystem::path & to, bool exchanges);

#endif
