// SPDX-License-Identifier: Apache-2.0
#include "LibraryMessages.h"

#include <iostream>

#include <unistd.h>

std::FILE *
GetTerminal()
{
  static std::FILE * const terminal = [] {
    std::FILE * const file = fdopen(dup(STDERR_FILENO), "w");
    if (file == nullptr)
    {
      return stderr;
    }
    setvbuf(file, nullptr, _IOLBF, BUFSIZ);
    return file;
  }();
  return terminal;
}

LibraryMessages::LibraryMessages()
  : m_File(std::tmpfile())
  , m_Output(std::cout.rdbuf(std::cerr.rdbuf()))
{
  GetTerminal();
  if (m_File != nullptr)
  {
    dup2(fileno(m_File), STDERR_FILENO);
  }
}

LibraryMessages::~LibraryMessages()
{
  std::cout.rdbuf(m_Output);
  if (m_File != nullptr)
  {
    dup2(fileno(GetTerminal()), STDERR_FILENO);
    std::fclose(m_File);
  }
}

std::string
LibraryMessages::GetText() const
{
  std::string text;
  char        bytes[4096];
  while (m_File != nullptr)
  {
    const auto count = pread(fileno(m_File), bytes, sizeof(bytes), static_cast<off_t>(text.size()));
    if (count <= 0)
    {
      break;
    }
    text.append(bytes, static_cast<std::size_t>(count));
  }
  return text;
}
