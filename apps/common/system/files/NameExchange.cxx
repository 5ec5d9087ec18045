// SPDX-License-Identifier: Apache-2.0
#include "system/files/NameExchange.h"

#include <cstdio>

#include <fcntl.h>

namespace fs = std::filesystem;

std::error_code
ExchangeNames(const fs::path & a, const fs::path & b)
{
#ifdef RENAME_EXCHANGE
  if (renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0)
  {
    return {};
  }
#endif
  const fs::path  aside = fs::path(a) += ".old";
  std::error_code error;
  fs::rename(b, aside, error);
  if (error)
  {
    return error;
  }
  fs::rename(a, b, error);
  if (error)
  {
    std::error_code ignored;
    fs::rename(aside, b, ignored);
    return error;
  }
  fs::rename(aside, a, error);
  return error;
}

std::error_code
GiveName(const fs::path & from, const fs::path & to, const bool exchanges)
{
  if (exchanges)
  {
    return ExchangeNames(from, to);
  }
  std::error_code error;
  fs::rename(from, to, error);
  return error;
}
