// SPDX-License-Identifier: Apache-2.0
#include "FormatTable.h"

#include "Formats.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace
{
std::string
JoinEndings(const VolumeFormat & format)
{
  std::string text;
  for (const char * const ending : format.Endings)
  {
    text += (text.empty() ? "" : " ") + std::string(ending);
  }
  return text;
}

/** What can be done piece by piece. */
std::string
DescribeStreaming(const VolumeFormat & format)
{
  const bool reads = format.Reader != nullptr && format.ReadsParts;
  const bool writes = format.Writer != nullptr && format.WritesParts;
  return reads && writes ? "both" : reads ? "read" : writes ? "write" : "-";
}

std::string
MakeLine(const std::string & name,
         const std::string & endings,
         const std::string & read,
         const std::string & write,
         const std::string & stream,
         const std::string & compress)
{
  char line[256];
  std::snprintf(line,
                sizeof(line),
                "%-16s %-34s %-5s %-6s %-7s %s\n",
                name.c_str(),
                endings.c_str(),
                read.c_str(),
                write.c_str(),
                stream.c_str(),
                compress.c_str());
  return line;
}

std::string
MakeTable()
{
  const auto  tell = [](bool is) { return std::string(is ? "yes" : "-"); };
  std::string text = MakeLine("format", "names", "read", "write", "stream", "compress");
  for (const VolumeFormat & format : GetVolumeFormats())
  {
    text += MakeLine(format.Name,
                     JoinEndings(format),
                     tell(format.Reader != nullptr),
                     tell(format.Writer != nullptr),
                     DescribeStreaming(format),
                     tell(format.Compresses));
  }
  return text + "stream: read or written piece by piece, so that a volume larger than memory can be.\n";
}

std::string
MakeJson()
{
  auto rows = nlohmann::ordered_json::array();
  for (const VolumeFormat & format : GetVolumeFormats())
  {
    nlohmann::ordered_json row;
    row["name"] = format.Name;
    row["endings"] = std::vector<std::string>(format.Endings.begin(), format.Endings.end());
    row["reads"] = format.Reader != nullptr;
    row["writes"] = format.Writer != nullptr;
    row["reads_parts"] = format.Reader != nullptr && format.ReadsParts;
    row["writes_parts"] = format.Writer != nullptr && format.WritesParts;
    row["compresses"] = format.Compresses;
    rows.push_back(row);
  }
  return rows.dump(2) + "\n";
}
} // namespace

std::string
DescribeFormats(const bool asJson)
{
  return asJson ? MakeJson() : MakeTable();
}
