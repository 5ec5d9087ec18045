// SPDX-License-Identifier: Apache-2.0
#ifndef SliceNames_h
#define SliceNames_h

#include "volumes/ImageDescription.h"

#include <filesystem>
#include <string>
#include <vector>

/** The slices of a folder, in the order of their numbers. */
struct SliceList
{
  std::string                        Format; // TIFF, PNG, BMP or JPEG; empty if there is no slice
  std::vector<std::filesystem::path> Files;
};

/** Lists the slices of a folder: the files whose names end as those of one image format and are alike but for one
 * number. Other files, hidden ones and folders are passed over. Gaps in the numbers, and a lone picture without a
 * number, which is left aside, are warned of.
 * \throw std::runtime_error if there are several formats or series, or two files of one number */
SliceList
ListSlices(const std::filesystem::path & folder, const WarningSink & warn);

#endif
