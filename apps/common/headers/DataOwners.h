// SPDX-License-Identifier: Apache-2.0
#ifndef DataOwners_h
#define DataOwners_h

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/** What a header, MetaImage's or NRRD's, calls the file of its voxels, "LIST" or a pattern included; empty if it does
 * not exist or names none.
 * \throw std::runtime_error if it cannot be read */
std::string
ReadDataName(const std::filesystem::path & header);

/** The paths of all data files that a header, MetaImage's or NRRD's, names: one, those of a list or those of a pattern.
 * \throw std::runtime_error */
std::vector<std::string>
ListDataFiles(const std::string & header);

/** A header beside a data file, other than that one, that names the data file: by its name, a pattern or in a list. One
 * that cannot be read might. */
std::optional<std::filesystem::path>
FindOtherOwner(const std::filesystem::path & data, const std::filesystem::path & header);

#endif
