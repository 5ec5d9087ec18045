// SPDX-License-Identifier: Apache-2.0
#ifndef DiskRoom_h
#define DiskRoom_h

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

/** Writes a small file and removes it. \return why there is no room for it, if so */
std::error_code
TryToWriteIn(const std::filesystem::path & folder);

/** The bytes that are free on the disk of a folder, if the system tells them. */
std::optional<std::uint64_t>
GetFreeBytes(const std::filesystem::path & folder);

/** Checks that the disk of a folder has so many free bytes, if the system tells how many it has.
 * \param path the output, for the message
 * \throw std::runtime_error if it has less */
void
CheckFreeBytes(const std::string & path, const std::filesystem::path & folder, std::uint64_t bytes);

/** The size that no file of this process may exceed, if there is a limit. */
std::optional<std::uint64_t>
GetFileSizeLimit();

#endif
