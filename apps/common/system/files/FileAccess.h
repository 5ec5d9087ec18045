// SPDX-License-Identifier: Apache-2.0
#ifndef FileAccess_h
#define FileAccess_h

#include <cstddef>
#include <filesystem>
#include <optional>
#include <system_error>

// What this process may do with files and their names.

/** Why a file that exists may not be written, if so. */
std::error_code
CheckMayWrite(const std::filesystem::path & file);

/** Whether a file belongs to another user in a folder, such as /tmp, where nobody may rename another's files. */
bool
IsStuck(const std::filesystem::path & file);

/** The number of bytes that a name in a folder may have, where there is a limit. */
std::optional<std::size_t>
GetLongestName(const std::filesystem::path & folder);

#endif
