// SPDX-License-Identifier: Apache-2.0
#include "system/files/ExtendedAttribute.h"

#ifdef __linux__
#  include <sys/xattr.h>

void
SetExtendedAttribute(const std::filesystem::path & path, const std::string & name, const std::string & text)
{
  static_cast<void>(setxattr(path.c_str(), name.c_str(), text.data(), text.size(), 0));
}

std::string
GetExtendedAttribute(const std::filesystem::path & path, const std::string & name)
{
  std::string text(1 << 16, '\0');
  const auto  size = getxattr(path.c_str(), name.c_str(), text.data(), text.size());
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return text;
}

#else

void
SetExtendedAttribute(const std::filesystem::path &, const std::string &, const std::string &)
{}

std::string
GetExtendedAttribute(const std::filesystem::path &, const std::string &)
{
  return {};
}

#endif
