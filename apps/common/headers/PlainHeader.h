// SPDX-License-Identifier: Apache-2.0
#ifndef PlainHeader_h
#define PlainHeader_h

#include "volumes/ImageDescription.h"
#include "volumes/VolumeWriter.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/** The text before the voxels of a .mha or .nrrd, or beside those of a .mhd or .nhdr. */
struct PlainHeader
{
  bool        IsNrrd = false;
  bool        IsDetached = false;
  std::string DataName; // of the file of the voxels; empty unless detached
  std::string Text;
};

bool
IsPlainFormat(const std::filesystem::path & output);

/** Composes the header from the grid and the metadata that the description has, and from nothing else.
 * \param dataName of the file of the voxels, where they have one; empty for the usual name */
PlainHeader
ComposePlainHeader(const std::filesystem::path & output,
                   const ImageDescription &      description,
                   const OutputOptions &         options,
                   const std::string &           dataName = {});

/** A name that is free in a folder, for voxels that cannot have theirs yet: scan.new-x1Y2z3.raw for scan.raw. */
std::string
MakeInterimDataName(const std::filesystem::path & folder, const std::string & dataName);

/** The output, and the files beside it that it replaces or that go with the one that it replaces, be they there or not.
 * \param output symbolic links followed */
std::vector<std::filesystem::path>
ListReplacedFiles(const std::filesystem::path & output, bool isCompressed);

/** \throw std::runtime_error if the data file would replace a file that is not that of an earlier output alone */
void
CheckDataFile(const std::filesystem::path & output, const std::string & dataName);

/** The header that is replaced may name the compressed voxels where the one that replaces it names plain ones, or the
 * other way round, or voxels that still have their interim name: they would be nobody's, and in the way of a later
 * output. The file to remove, if it is so. */
std::optional<std::filesystem::path>
FindOldDataFile(const std::filesystem::path & output, bool isCompressed);

/** Reads a header as it is found by others, and the sizes of the files with it.
 * \param meant the name that messages call the file by
 * \throw std::runtime_error if it is not that of such an image */
void
CheckPlainFile(const std::string & file, const std::string & meant, const ImageDescription & description);

#endif
