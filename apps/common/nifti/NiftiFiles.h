// SPDX-License-Identifier: Apache-2.0
#ifndef NiftiFiles_h
#define NiftiFiles_h

#include <filesystem>
#include <string>
#include <vector>

// The library of NIfTI looks for the files of an image by the stem of the name that it is given, whatever its ending.

/** Whether a name has an ending of NIfTI that is neither in small letters nor in capitals: the library knows no other.
 */
bool
HasNiftiEndingInMixedCase(const std::string & path);

/** The ending of a compressed NIfTI file, as it is written, if there is a neighbour that differs in its lacking ".gz"
 * alone: the library would take the neighbour's voxels. Otherwise an empty text. */
std::string
GetMistakenNiftiEnding(const std::string & path);

/** The header and the voxels of an image of two files. */
struct NiftiPair
{
  std::string Header;
  std::string Voxels;
};

bool
IsNiftiPair(const std::string & path);

/** The two files of the pair that one of them belongs to.
 * \throw std::runtime_error if one is missing, or is there twice, compressed and not */
NiftiPair
FindNiftiPair(const std::string & path);

/** The names of both files of a pair that is written under the name of one of them. */
std::vector<std::filesystem::path>
ListWrittenPair(const std::string & path);

/** The names of both files as they are where the pair is compressed, if this one is not, or the other way round; none
 * for a single file. */
std::vector<std::filesystem::path>
ListOtherPair(const std::string & path);

#endif
