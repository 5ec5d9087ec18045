// SPDX-License-Identifier: Apache-2.0
#ifndef TemporaryFolder_h
#define TemporaryFolder_h

#include "outputs/PairNaming.h"
#include "system/process/Interrupt.h"
#include "volumes/ImageDescription.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

/** The file that a name leads to, whether it exists or not: a symbolic link is to stay one.
 * \throw std::runtime_error if it is a link to itself */
std::filesystem::path
ResolveOutput(std::filesystem::path output);

/** Warns where an image of two files is to be written under the name of a link: both stand where that leads to, and may
 * not be found by the link's name. */
void
WarnOfLinkToPair(const std::filesystem::path & output, const WarningSink & warn);

/** A hidden folder beside the output in which the output is written under its own name. The formats that write several
 * files name one in the other; these names are right from the start. When all is written, the files are renamed into
 * place. Otherwise the folder is removed, also when the program is interrupted: a half-written file never bears the
 * output's name. */
class TemporaryFolder
{
public:
  /** Where the output's folder cannot be written but the output exists and can, the temporary folder is among the
   * system's, and Commit() copies over the output; a warning says so.
   * \throw std::runtime_error if the output cannot be written either */
  explicit TemporaryFolder(const std::filesystem::path & output, const WarningSink & warn = [](const std::string &) {});
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &
  operator=(const TemporaryFolder &) = delete;

  /** Where the output is to be written. */
  std::filesystem::path
  GetFileName() const;

  /** The output's name, symbolic links followed. */
  const std::filesystem::path &
  GetOutput() const
  {
    return m_Output;
  }

  /** Some formats' writers do not tell of a write that failed. It failed because the disk is full, and then there is no
   * room for another file either, or because a file reached its size limit.
   * \throw std::runtime_error */
  void
  CheckThatAllWasWritten() const;

  /** Removes all files. */
  void
  Clear();

  /** Lets Commit() replace a file beside the output. Without it, no file but the output is ever replaced. */
  void
  AllowReplacing(const std::string & name);

  /** Lets Commit() remove a file beside the output, which belonged to the one that is replaced. */
  void
  RemoveAfterwards(const std::string & name);

  /** Tells Commit() that the output is a header which names the voxels' file beside it, and how to compose it. */
  void
  NameDataBy(const std::string & dataName, const std::function<std::string(const std::string &)> & composeHeader);

  /** Tells Commit() that the disk has room for all that was written. An output that replaces none then need not be
   * waited for until it is on the disk: a disk that fails later takes nothing that was there before.
   * \return whether Commit() will not wait */
  bool
  RelyOnRoom();

  /** Brings all files to the disk and renames them, the named output last, so that no moment lies between at which the
   * old one stands beside another's files. Files whose names alone make them one image, as .hdr and .img, lack the
   * named one meanwhile.
   * \throw std::runtime_error if the disk is full or another file stands in the way */
  void
  Commit();

private:
  /** \param output as messages name it
   * \throw std::runtime_error if no file can have that name, or the one that has it may not be replaced */
  void
  CheckOutput(const std::filesystem::path & output) const;
  /** \return why it cannot be made there, if so */
  std::error_code
  Make(const std::filesystem::path & folder);
  void
  GiveNames(const std::vector<std::filesystem::path> & names);
  void
  Remove(const InterruptLock & lock);

  std::filesystem::path       m_Output;
  std::filesystem::path       m_Folder;
  bool                        m_IsInPlace = false;
  bool                        m_WaitsForDisk = true;
  std::set<std::string>       m_Replaceable;
  std::set<std::string>       m_Obsolete;
  std::optional<DetachedPair> m_Pair;
};

#endif
