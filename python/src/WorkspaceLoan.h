// SPDX-License-Identifier: Apache-2.0
#ifndef WorkspaceLoan_h
#define WorkspaceLoan_h

#include "NonOscillatorySubdivision/Subdivider.h"

#include <memory>
#include <mutex>

/** \brief A workspace for one run. One is kept from run to run, which makes small arrays quick; runs at the same time
 * get one each. */
class WorkspaceLoan
{
public:
  WorkspaceLoan()
  {
    {
      const std::lock_guard<std::mutex> lock(s_Mutex);
      m_Workspace = std::move(s_Kept);
    }
    if (!m_Workspace)
    {
      m_Workspace = std::make_unique<itk::Subdivision::Workspace>();
    }
  }

  ~WorkspaceLoan()
  {
    const std::lock_guard<std::mutex> lock(s_Mutex);
    if (!s_Kept)
    {
      s_Kept = std::move(m_Workspace);
    }
  }

  WorkspaceLoan(const WorkspaceLoan &) = delete;
  WorkspaceLoan &
  operator=(const WorkspaceLoan &) = delete;

  itk::Subdivision::Workspace &
  Get()
  {
    return *m_Workspace;
  }

private:
  std::unique_ptr<itk::Subdivision::Workspace> m_Workspace;

  static inline std::mutex                                   s_Mutex;
  static inline std::unique_ptr<itk::Subdivision::Workspace> s_Kept;
};

#endif
