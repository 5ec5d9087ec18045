// SPDX-License-Identifier: Apache-2.0
#include "Warnings.h"

#include "LibraryMessages.h"
#include "OneLineMessage.h"

#include <cstdio>

void
Warnings::Add(const std::string & warning)
{
  const std::string                 line = MakeOneLine(warning);
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_All.push_back(line);
  if (!m_IsQuiet)
  {
    std::fprintf(GetTerminal(), "SubdivideVolume: warning: %s\n", line.c_str());
  }
}

std::vector<std::string>
Warnings::GetAll() const
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  return m_All;
}
