// SPDX-License-Identifier: Apache-2.0
#include "commandline/Warnings.h"

#include "system/process/Terminal.h"
#include "text/OneLineMessage.h"

#include <cmath>
#include <limits>

void
Warnings::Add(const std::string & warning)
{
  const std::string                 line = MakeOneLine(warning);
  const std::lock_guard<std::mutex> lock(m_Mutex);
  m_All.push_back(line);
  if (!m_IsQuiet)
  {
    TellUser("warning: " + line);
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
