// SPDX-License-Identifier: Apache-2.0
#include "itk/LinkFolder.h"
#include "system/files/UniqueFolder.h"
#include "system/process/Interrupt.h"

#include <stdexcept>

namespace fs = std::filesystem;

std::shared_ptr<LinkFolder>
LinkFolder::Get()
{
  static std::weak_ptr<LinkFolder> current;
  auto                             folder = current.lock();
  if (folder == nullptr)
  {
    folder = std::shared_ptr<LinkFolder>(new LinkFolder);
    current = folder;
  }
  return folder;
}

LinkFolder::LinkFolder()
{
  std::error_code error;
  const auto      lock = HoldInterrupts();
  m_Folder = MakeUniqueFolder(fs::temp_directory_path() / ".links-", error);
  if (error)
  {
    throw std::runtime_error("cannot make a temporary folder in " + fs::temp_directory_path().string() + ": " +
                             error.message());
  }
  GetRunRecord().LinkFolder.Set(m_Folder);
}

LinkFolder::~LinkFolder()
{
  std::error_code error;
  const auto      lock = HoldInterrupts();
  fs::remove_all(m_Folder, error);
  GetRunRecord().LinkFolder.Set({});
}

std::string
LinkFolder::Link(const std::string & file, const std::string & ending)
{
  const fs::path link = m_Folder / ("image" + std::to_string(m_Count++) + ending);
  fs::create_symlink(fs::absolute(file), link);
  return link.string();
}
