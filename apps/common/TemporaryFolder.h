// SPDX-License-Identifier: Apache-2.0
#ifndef TemporaryFolder_h
#define TemporaryFolder_h

#include <filesystem>

/** A hidden folder beside the output in which the output is written under its own name. The formats that write several
 * files name one in the other; these names are right from the start. When all is written, the files are renamed into
 * place. Otherwise the folder is removed, also when the program is interrupted: a half-written file never bears the
 * output's name. */
class TemporaryFolder
{
public:
  /** \throw std::runtime_error if the folder of the output cannot be written */
  explicit TemporaryFolder(const std::filesystem::path & output);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &
  operator=(const TemporaryFolder &) = delete;

  /** Where the output is to be written. */
  std::filesystem::path
  GetFileName() const;

  /** Some formats' writers do not tell of a write that failed. It failed because the disk is full, and then there is no
   * room for another file either, or because a file reached its size limit.
   * \throw std::runtime_error */
  void
  CheckThatAllWasWritten() const;

  /** Removes all files. */
  void
  Clear();

  /** Brings all files to the disk and renames them, the named output last.
   * \throw std::runtime_error if the disk is full or another file stands in the way */
  void
  Commit();

private:
  std::filesystem::path m_Output;
  std::filesystem::path m_Folder;
};

#endif
