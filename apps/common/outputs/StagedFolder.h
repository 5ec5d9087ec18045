// SPDX-License-Identifier: Apache-2.0
#ifndef StagedFolder_h
#define StagedFolder_h

#include <filesystem>
#include <system_error>

/** A folder that is written under a hidden name beside its own, and takes its name when it is complete. Otherwise it is
 * removed, also when the program is interrupted. */
class StagedFolder
{
public:
  /** \throw std::runtime_error if the folder above it cannot be written */
  explicit StagedFolder(const std::filesystem::path & output);
  ~StagedFolder();
  StagedFolder(const StagedFolder &) = delete;
  StagedFolder &
  operator=(const StagedFolder &) = delete;

  /** Where the files are to be written. */
  const std::filesystem::path &
  GetPath() const
  {
    return m_Folder;
  }

  /** Brings all files to the disk and gives the folder its name, in one step. A folder of that name, whatever it holds,
   * gives way.
   * \throw std::runtime_error */
  void
  Commit();

private:
  [[noreturn]] void
  Fail(const std::error_code & error) const;

  std::filesystem::path m_Output;
  std::filesystem::path m_Folder;
};

#endif
