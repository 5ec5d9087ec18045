// SPDX-License-Identifier: Apache-2.0
#ifndef PairNaming_h
#define PairNaming_h

#include <filesystem>
#include <functional>
#include <string>

/** A header and the file of its voxels, written in a folder, that are to get their names in another one. */
struct DetachedPair
{
  std::filesystem::path                                    Folder; // where both were written
  std::filesystem::path                                    Output; // what the header is to be called
  std::string                                              DataName;
  std::function<std::string(const std::string & dataName)> ComposeHeader;
};

/** Gives both their names. No moment lies between at which a header names voxels of another image: where the header
 * that is replaced names a data file of the same name, the header first refers to the voxels by an interim name, until
 * they have taken theirs. The voxels stay in their folder as well, where the file system has hard links.
 * \throw std::runtime_error */
void
GiveNames(const DetachedPair & pair);

#endif
