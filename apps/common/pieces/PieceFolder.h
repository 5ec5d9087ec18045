// SPDX-License-Identifier: Apache-2.0
#ifndef PieceFolder_h
#define PieceFolder_h

#include "pieces/AgreementText.h"
#include "pieces/PieceWriter.h"
#include "system/files/FileDescriptor.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

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

  /** The number of pieces that an output was made of, if it is known and nothing has changed it since. */
  static std::optional<unsigned int>
  FindNumberOfCompletePieces(const std::filesystem::path & output);

  /** Joins what others have begun, or begins it.
   * \return false if there is nothing to do, since the output was made so before
   * \throw std::runtime_error that names the difference, if others have agreed on something else */
  bool
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

  /** Whether the output has its name. */
  bool
  IsFinished() const;

  /** The same, once no other process is about to give it. */
  bool
  IsFinishedByAnother() const;

private:
  void
  MakeTemporaryFolder(const std::filesystem::path & start, const std::filesystem::path & unfinished);
  bool
  TryToJoin(const PieceAgreement & agreement);
  void
  Begin(const PieceAgreement & agreement, const PieceWriter & writer);
  void
  Complete(const PieceWriter & writer) const;
  void
  GiveNames(const PieceWriter & writer) const;
  void
  Remove() const;
  [[noreturn]] void
  Fail(const std::string & reason) const;

  std::filesystem::path m_Output;
  std::filesystem::path m_Folder;
  std::filesystem::path m_Temporary;
  unsigned int          m_Pieces;
  FileDescriptor        m_Agreement; // the open file
  std::string           m_Identity;  // of the output as it was laid out
};

#endif
