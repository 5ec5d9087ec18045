// SPDX-License-Identifier: Apache-2.0
#include "FormatTable.h"

#include "formats/Formats.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <vector>

namespace
{
/** A row of the table. */
struct Row
{
  std::string              Name;
  std::vector<std::string> Names; // of files: what they end in, or what else they are
  bool                     Reads;
  bool                     Writes;
  bool                     ReadsParts;
  bool                     WritesParts;
  bool                     Compresses;
};

std::vector<Row>
GetRows()
{
  std::vector<Row> rows;
  for (const VolumeFormat & format : GetVolumeFormats())
  {
    const bool reads = format.Reader != nullptr;
    const bool writes = format.Writer != nullptr;
    rows.push_back({ format.Name,
                     { format.Endings.begin(), format.Endings.end() },
                     reads,
                     writes,
                     reads && format.ReadsParts,
                     writes && format.WritesParts,
                     format.Compresses });
  }
  rows.push_back({ "slices", { "a folder of TIFF, PNG, BMP, JPEG" }, true, true, true, true, true });
  rows.push_back({ "DICOM", { "a folder, DICOMDIR or file" }, true, false, true, false, false });
  rows.push_back({ "raw voxels", { "any, with --raw" }, true, false, true, false, false });
  return rows;
}

std::string
JoinNames(const Row & row)
{
  std::string text;
  for (const std::string & name : row.Names)
  {
    text += (text.empty() ? "" : " ") + name;
  }
  return text;
}

std::string
MakeLine(const std::string & name,
         const std::string & names,
         const std::string & read,
         const std::string & write,
         const std::string & stream,
         const std::string & compress)
{
  char line[256];
  std::snprintf(line,
                sizeof(line),
                "%-11s %-35s %-5s %-6s %-7s %s\n",
                name.c_str(),
                names.c_str(),
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
  for (const Row & row : GetRows())
  {
    const char * const stream = row.ReadsParts && row.WritesParts ? "both"
                                : row.ReadsParts                  ? "read"
                                : row.WritesParts                 ? "write"
                                                                  : "-";
    text += MakeLine(row.Name, JoinNames(row), tell(row.Reads), tell(row.Writes), stream, tell(row.Compresses));
  }
  return text + "stream: read or written piece by piece, so that a volume larger than memory can be.\n";
}

std::string
MakeJson()
{
  auto array = nlohmann::ordered_json::array();
  for (const Row & row : GetRows())
  {
    array.push_back({ { "name", row.Name },
                      { "endings", row.Names },
                      { "reads", row.Reads },
                      { "writes", row.Writes },
                      { "reads_parts", row.ReadsParts },
                      { "writes_parts", row.WritesParts },
                      { "compresses", row.Compresses } });
  }
  return array.dump(2) + "\n";
}
} // namespace

std::string
DescribeFormats(const bool asJson)
{
  return asJson ? MakeJson() : MakeTable();
}
