// SPDX-License-Identifier: Apache-2.0
#ifndef Warnings_h
#define Warnings_h

#include "volumes/ImageDescription.h"

#include <mutex>
#include <string>
#include <vector>

/** Shows warnings as they come, from any thread, and keeps them for the summary. */
class Warnings
{
public:
  explicit Warnings(bool isQuiet)
    : m_IsQuiet(isQuiet)
  {}

  void
  Add(const std::string & warning);

  std::vector<std::string>
  GetAll() const;

private:
  const bool               m_IsQuiet;
  mutable std::mutex       m_Mutex;
  std::vector<std::string> m_All;
};

/** Warns if integers of a range may be none that double can hold, in which the programs compute. */
void
WarnOfRounding(const std::string &           path,
               itk::Subdivision::ElementType type,
               double                        minimum,
               double                        maximum,
               const WarningSink &           warn);

#endif
