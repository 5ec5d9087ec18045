// SPDX-License-Identifier: Apache-2.0
#ifndef PieceWriter_h
#define PieceWriter_h

#include "outputs/PairNaming.h"
#include "volumes/VolumeWriter.h"

#include "NonOscillatorySubdivision/ArrayView.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/** Boxes of an output, each of which continues the one before. */
using Piece = std::vector<itk::Subdivision::Box>;

/** Writes one piece of an image whose other pieces are written by others, into a folder that they share. Begin() comes
 * first; Write() and Commit() after Open(). Commit() brings the piece to the disk, but gives nothing its name. */
class PieceWriter : public VolumeWriter
{
public:
  /** The output's path, symbolic links followed. */
  virtual const std::filesystem::path &
  GetOutput() const = 0;

  /** Whether several pieces may share a plane. */
  virtual bool
  SplitsPlanes() const = 0;

  /** Lays out in an empty folder what the pieces are written into. */
  virtual void
  LayOut(const std::filesystem::path & folder) const = 0;

  /** Opens what was laid out. \param temporary a folder for files that have no name yet */
  virtual void
  Open(const std::filesystem::path & folder, const std::filesystem::path & temporary, const Piece & piece) = 0;

  /** The checksum of a piece as a folder has it.
   * \throw std::runtime_error if it is not there */
  virtual std::uint32_t
  ReadChecksum(const std::filesystem::path & folder, const Piece & piece) const = 0;

  /** Checks that all files are there, and may get their names.
   * \throw std::runtime_error */
  virtual void
  CheckAll(const std::filesystem::path & folder) const = 0;

  /** The header and its data file, as the folder has them, if the output is such a pair. */
  virtual std::optional<DetachedPair>
  FindPair(const std::filesystem::path & folder) const = 0;

  /** A file beside the output that belongs to the one that is replaced, and goes with it. */
  virtual std::optional<std::filesystem::path>
  FindOldData() const = 0;
};

/** \throw std::runtime_error if the output's format is not written in pieces of several processes */
std::unique_ptr<PieceWriter>
CreatePieceWriter(const std::string & path, const OutputOptions & options, const WarningSink & warn);

std::unique_ptr<PieceWriter>
CreatePlainPieceWriter(const std::string & path, const OutputOptions & options, const WarningSink & warn);

std::unique_ptr<PieceWriter>
CreateSlicePieceWriter(const std::string & path, const OutputOptions & options, const WarningSink & warn);

/** Goes on with the checksum of some bytes; the first starts with 0. */
std::uint32_t
AddToChecksum(std::uint32_t checksum, const void * bytes, std::uint64_t count);

/** The same for bytes of a file.
 * \throw std::runtime_error */
std::uint32_t
AddToChecksum(std::uint32_t checksum, const std::filesystem::path & file, std::uint64_t offset, std::uint64_t count);

#endif
