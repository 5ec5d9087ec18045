// SPDX-License-Identifier: Apache-2.0
#ifndef LinkFolder_h
#define LinkFolder_h

#include <filesystem>
#include <memory>
#include <string>

/** A folder among the system's temporary ones with links to files that must not be opened beside their neighbours. It
 * is removed with the last that holds it, and when the run is interrupted or dies. */
class LinkFolder
{
public:
  /** The one folder of this process. \throw std::runtime_error if it cannot be made */
  static std::shared_ptr<LinkFolder>
  Get();

  ~LinkFolder();
  LinkFolder(const LinkFolder &) = delete;
  LinkFolder &
  operator=(const LinkFolder &) = delete;

  /** \return the name of a link to the file that ends like that and has no neighbour of its stem */
  std::string
  Link(const std::string & file, const std::string & ending);

private:
  LinkFolder();

  std::filesystem::path m_Folder;
  int                   m_Count = 0;
};

#endif
