// SPDX-License-Identifier: Apache-2.0
#include "outputs/StagedFolder.h"
#include "outputs/ReplacedFiles.h"
#include "system/files/DiskSync.h"
#include "system/files/NameExchange.h"
#include "system/files/UniqueFolder.h"
#include "system/process/Interrupt.h"

#include <stdexcept>

namespace fs = std::filesystem;

StagedFolder::StagedFolder(const fs::path & output)
{
  std::error_code error;
  const fs::path  resolved = fs::weakly_canonical(output, error);
  m_Output = error ? fs::absolute(output) : resolved;
  const auto lock = HoldInterrupts();
  m_Folder = MakeUniqueFolder(m_Output.parent_path() / ("." + m_Output.filename().string() + ".partial-"), error);
  if (error)
  {
    this->Fail(error);
  }
  RemoveWhenInterrupted(lock, m_Folder, m_Output);
}

StagedFolder::~StagedFolder() { RemoveTemporaryFolder(HoldInterrupts(), m_Folder); }

void
StagedFolder::Fail(const std::error_code & error) const
{
  throw std::runtime_error("cannot write " + m_Output.string() + ": " + error.message());
}

void
StagedFolder::Commit()
{
  for (const fs::directory_entry & entry : fs::directory_iterator(m_Folder))
  {
    if (const std::error_code error = BringToDisk(entry.path()))
    {
      this->Fail(error);
    }
  }
  const bool replaces = KeepPermissions(m_Output, m_Folder);
  if (!replaces)
  {
    AllowUsualAccess(m_Folder);
  }
  const auto lock = HoldInterrupts();
  if (const std::error_code error = GiveName(m_Folder, m_Output, replaces))
  {
    this->Fail(error);
  }
}
