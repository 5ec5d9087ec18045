// SPDX-License-Identifier: Apache-2.0
#include "commandline/Warnings.h"

#include "system/LibraryMessages.h"
#include "text/OneLineMessage.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <limits>

void
Warnings::Add(const std::string & warning)
{
  const std::string                 line = MakeOneLine(warning);
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_All.push_back(line);
  if (!m_IsQuiet)
  {
    std::fprintf(GetTerminal(), "%s: warning: %s\n", program_invocation_short_name, line.c_str());
  }
}

std::vector<std::string>
Warnings::GetAll() const
{
  const std::lock_guard<std::mutex> lock(m_Mutex);
  return m_All;
}

void
WarnOfRounding(const std::string &                 path,
               const itk::Subdivision::ElementType type,
               const double                        minimum,
               const double                        maximum,
               const WarningSink &                 warn)
{
  const double largest = std::ldexp(1.0, std::numeric_limits<double>::digits);
  if (itk::Subdivision::IsInteger(type) && itk::Subdivision::SizeOf(type) > 4 &&
      (minimum <= -largest || maximum >= largest))
  {
    warn(path + " holds integers beyond 2^53: they were rounded to double precision, in which they are computed with");
  }
}
