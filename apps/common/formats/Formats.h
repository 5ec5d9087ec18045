// SPDX-License-Identifier: Apache-2.0
#ifndef Formats_h
#define Formats_h

#include "volumes/VolumeReader.h"
#include "volumes/VolumeWriter.h"

#include <memory>
#include <string>
#include <vector>

/** A format of image files, for the programs and for people. */
struct VolumeFormat
{
  using Open = std::unique_ptr<VolumeReader> (*)(const std::string &, const InputOptions &, const WarningSink &);
  using Create = std::unique_ptr<VolumeWriter> (*)(const std::string &, const OutputOptions &, const WarningSink &);

  const char *              Name;
  std::vector<const char *> Endings; // in small letters
  Open                      Reader;  // null: it is not read
  Create                    Writer;  // null: it is not written
  bool                      ReadsParts;
  bool                      WritesParts;
  bool                      Compresses;
};

/** All formats of files. */
const std::vector<VolumeFormat> &
GetVolumeFormats();

/** The format whose ending a name has, in capitals or not; null: none has. */
const VolumeFormat *
FindVolumeFormat(const std::string & path);

/** Opens a file by the one of ITK's readers that its first bytes, or else its name, ask for. */
std::unique_ptr<VolumeReader>
OpenByItk(const std::string & path, const InputOptions & options, const WarningSink & warn);

#endif
