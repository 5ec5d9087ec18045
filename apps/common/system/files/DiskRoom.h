// SPDX-License-Identifier: Apache-2.0
#ifndef DiskRoom_h
#define DiskRoom_h

#include <cstdint>
#include <filesystem>
#include <optional>
#include <system_error>

/** Writes a small file and removes it. \return why there is no room for it, if so */
std::error_code
TryToWriteIn(const std::filesystem::path & folder);

/** The size that no file of this process may exceed, if there is a limit. */
std::optional<std::uint64_t>
GetFileSizeLimit();

#endif
