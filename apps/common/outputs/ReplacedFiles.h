// SPDX-License-Identifier: Apache-2.0
#ifndef ReplacedFiles_h
#define ReplacedFiles_h

#include <filesystem>
#include <vector>

// How files that are complete take the place of others.

/** Gives a file or folder the permissions of the one that it is to replace.
 * \return whether there is one */
bool
KeepPermissions(const std::filesystem::path & replaced, const std::filesystem::path & file);

/** Copies over a file that exists, without making it anew. The new size is taken first, while the old bytes are all
 * there.
 * \throw std::runtime_error */
void
CopyOver(const std::filesystem::path & from, const std::filesystem::path & to);

/** Renames files of one image, the last of which names them all, from a folder into another. Where it replaces one, the
 * others of that go first, so that files of two images never stand together. After an error, all is as it was.
 * \throw std::filesystem::filesystem_error */
void
ReplaceTogether(const std::filesystem::path &      folder,
                const std::filesystem::path &      target,
                std::vector<std::filesystem::path> names);

#endif
