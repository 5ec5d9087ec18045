// SPDX-License-Identifier: Apache-2.0
#ifndef CurrentFolder_h
#define CurrentFolder_h

#include <filesystem>

/** Makes a folder the current one as long as this lives. Image libraries may look for a file's name in the current
 * folder before they look where they were told to: any other folder could hold somebody else's file of that name. */
class CurrentFolder
{
public:
  explicit CurrentFolder(const std::filesystem::path & folder)
    : m_Before(std::filesystem::current_path())
  {
    std::filesystem::current_path(folder);
  }
  ~CurrentFolder()
  {
    std::error_code error;
    std::filesystem::current_path(m_Before, error);
  }
  CurrentFolder(const CurrentFolder &) = delete;
  CurrentFolder &
  operator=(const CurrentFolder &) = delete;

private:
  std::filesystem::path m_Before;
};

#endif
