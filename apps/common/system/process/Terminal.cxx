// SPDX-License-Identifier: Apache-2.0
#include "system/process/Terminal.h"

#include <cerrno>

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

bool
IsSeenByUser()
{
  return isatty(fileno(GetTerminal())) != 0;
}

void
TellUser(const std::string & line)
{
  std::fprintf(GetTerminal(), "%s: %s\n", program_invocation_short_name, line.c_str());
}
