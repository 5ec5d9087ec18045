// SPDX-License-Identifier: Apache-2.0
#include "system/process/LibraryMessages.h"
#include "system/process/Terminal.h"

#include <cstdio>
#include <iostream>

#include <unistd.h>

namespace
{
std::FILE *
GetFile()
{
  static std::FILE * const file = std::tmpfile();
  return file;
}

/** What stands in the file from a place on. */
std::string
ReadFrom(std::size_t start)
{
  std::string text;
  char        bytes[4096];
  while (GetFile() != nullptr)
  {
    const auto count = pread(fileno(GetFile()), bytes, sizeof(bytes), static_cast<off_t>(start + text.size()));
    if (count <= 0)
    {
      break;
    }
    text.append(bytes, static_cast<std::size_t>(count));
  }
  return text;
}

std::size_t
GetEnd()
{
  const off_t end = GetFile() == nullptr ? 0 : lseek(fileno(GetFile()), 0, SEEK_END);
  return end < 0 ? 0 : static_cast<std::size_t>(end);
}
} // namespace

LibraryMessages::LibraryMessages()
  : m_Start(GetEnd())
  , m_Errors(dup(STDERR_FILENO))
  , m_Output(std::cout.rdbuf(std::cerr.rdbuf()))
{
  Prepare();
  if (GetFile() != nullptr)
  {
    dup2(fileno(GetFile()), STDERR_FILENO);
  }
}

LibraryMessages::~LibraryMessages()
{
  std::cout.rdbuf(m_Output);
  std::fflush(stderr);
  dup2(m_Errors.GetNumber(), STDERR_FILENO);
}

std::string
LibraryMessages::GetText() const
{
  return ReadFrom(m_Start);
}

void
LibraryMessages::Prepare()
{
  GetTerminal();
  GetFile();
}

std::string
LibraryMessages::GetWholeText()
{
  return ReadFrom(0);
}
