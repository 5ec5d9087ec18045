// SPDX-License-Identifier: Apache-2.0
#include "pieces/PieceMark.h"

#include "system/files/ExtendedAttribute.h"
#include "system/files/FileState.h"

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
  SetExtendedAttribute(output, AttributeName, agreement + DescribeState(output));
}

std::string
ReadMark(const std::filesystem::path & output)
{
  const std::string text = GetExtendedAttribute(output, AttributeName);
  const std::string state = DescribeState(output);
  const bool isSame = text.size() >= state.size() && text.compare(text.size() - state.size(), state.size(), state) == 0;
  return isSame ? text.substr(0, text.size() - state.size()) : "";
}
