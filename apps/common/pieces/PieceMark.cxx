// SPDX-License-Identifier: Apache-2.0
#include "pieces/PieceMark.h"

#include "system/FileState.h"

#ifdef __linux__
#  include <sys/xattr.h>
#endif

namespace
{
constexpr const char * AttributeName = "user.SubdivideVolume.pieces";

std::string
DescribeState(const std::filesystem::path & output)
{
  return "state of the output: " + DescribeFiles(output) + "\n";
}
} // namespace

void
MarkAsComplete(const std::filesystem::path & output, const std::string & agreement)
{
#ifdef __linux__
  const std::string text = agreement + DescribeState(output);
  static_cast<void>(setxattr(output.c_str(), AttributeName, text.data(), text.size(), 0));
#endif
}

std::string
ReadMark(const std::filesystem::path & output)
{
  std::string text(1 << 16, '\0');
#ifdef __linux__
  const auto size = getxattr(output.c_str(), AttributeName, text.data(), text.size());
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
#else
  text.clear();
#endif
  const std::string state = DescribeState(output);
  const bool isSame = text.size() >= state.size() && text.compare(text.size() - state.size(), state.size(), state) == 0;
  return isSame ? text.substr(0, text.size() - state.size()) : "";
}
