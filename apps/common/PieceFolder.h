// SPDX-License-Identifier: Apache-2.0
#ifndef PieceFolder_h
#define PieceFolder_h

#include "PieceWriter.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/** What all pieces of an output must agree on, in words and in the order of messages: "scheme", "linear". */
using PieceAgreement = std::vector<std::pair<std::string, std::string>>;

/** The folder .NAME.pieces beside an output, which the processes share that make its pieces: the output as it grows,
 * the agreement, and a note for each piece that is done. It is gone when the output has its name. */
class PieceFolder
{
public:
  /** \param output symbolic links followed */
  PieceFolder(const std::filesystem::path & output, unsigned int pieces);
  ~PieceFolder();
  PieceFolder(const PieceFolder &) = delete;
  PieceFolder &
  operator=(const PieceFolder &) = delete;

  /** The number of pieces of what is being made, if anything is. */
  static std::optional<unsigned int>
  FindNumberOfPieces(const std::filesystem::path & output);

  /** Joins what others have begun, or begins it.
   * \throw std::runtime_error that names the difference, if others have agreed on something else */
  void
  Join(const PieceAgreement & agreement, const PieceWriter & writer);

  /** Where the output grows. */
  std::filesystem::path
  GetOutputFolder() const;

  /** A folder for this process alone; gone with this object. */
  const std::filesystem::path &
  MakeTemporaryFolder();

  /** The checksum of a piece, counted from 1, if it is done. */
  std::optional<std::uint32_t>
  FindNote(unsigned int piece) const;

  /** Notes that a piece is done. */
  void
  Note(unsigned int piece, std::uint32_t checksum);

  std::vector<unsigned int>
  FindMissing() const;

  /** Where all pieces are done, gives the output its name, unless another process does.
   * \return whether the output is complete
   * \throw std::runtime_error */
  bool
  Finish(const PieceWriter & writer);

  /** Whether another process has given the output its name meanwhile. */
  bool
  IsFinished() const;

private:
  bool
  TryToJoin(const PieceAgreement & agreement);
  void
  Begin(const PieceAgreement & agreement, const PieceWriter & writer);
  void
  GiveNames() const;
  void
  Remove() const;
  [[noreturn]] void
  Fail(const std::string & reason) const;

  std::filesystem::path m_Output;
  std::filesystem::path m_Folder;
  std::filesystem::path m_Temporary;
  unsigned int          m_Pieces;
  int                   m_Agreement = -1; // the open file
  std::string           m_Identity;       // of the output as it was laid out
};

#endif
