// SPDX-License-Identifier: Apache-2.0
#ifndef UniqueFolder_h
#define UniqueFolder_h

#include <filesystem>
#include <system_error>

/** Makes a folder that no other process has, for this user alone, whose name starts so and ends in six letters and
 * digits.
 * \return its path; empty, with the error, if it cannot be made */
std::filesystem::path
MakeUniqueFolder(const std::filesystem::path & start, std::error_code & error);

/** Gives such a folder the permissions that this user's folders have. */
void
AllowUsualAccess(const std::filesystem::path & folder);

#endif
