// SPDX-License-Identifier: Apache-2.0
#include "PlainHeader.h"
#include "HeaderText.h"
#include "InputFile.h"
#include "MetaHeader.h"
#include "Metadata.h"
#include "NrrdHeader.h"

#include <algorithm>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{
[[noreturn]] void
Fail(const std::string & path, const std::string & reason)
{
  throw std::runtime_error("cannot write " + path + ": " + reason);
}

bool
IsNrrd(const fs::path & output)
{
  const std::string ending = ToLower(output.extension().string());
  return ending == ".nrrd" || ending == ".nhdr";
}

/** A name that no reader takes for a list, a pattern or several words, and that the file system can hold. */
std::string
GetDataName(const fs::path & output, const bool isCompressed)
{
  constexpr std::size_t longest = 255;
  const std::string     ending = isCompressed ? (IsNrrd(output) ? ".raw.gz" : ".zraw") : ".raw";
  std::string           stem = output.stem().string();
  stem.resize(std::min(stem.size(), longest - ending.size()));
  for (char & c : stem)
  {
    const auto code = static_cast<unsigned char>(c);
    c = code < ' ' || code == 0x7f || c == '%' ? '_' : c;
  }
  if (stem.front() == ' ')
  {
    stem.front() = '_';
  }
  return stem + ending;
}

/** What an existing header calls the file of its voxels; empty if it does not exist or names none. */
std::string
ReadDataName(const fs::path & header)
{
  std::error_code error;
  if (!fs::is_regular_file(header, error))
  {
    return {};
  }
  const std::string text = InputFile(header.string()).ReadTextAt(0, 1 << 20) + "\n";
  for (std::size_t start = 0, end = 0; (end = text.find('\n', start)) != std::string::npos; start = end + 1)
  {
    const std::string line = text.substr(start, end - start);
    const auto        separator = line.find_first_of("=:");
    const std::string key = separator == std::string::npos ? "" : ToLower(Trim(line.substr(0, separator)));
    if (key == "elementdatafile" || key == "data file" || key == "datafile")
    {
      const std::string value = Trim(line.substr(separator + 1));
      return value.rfind("./", 0) == 0 ? value.substr(2) : value;
    }
  }
  return {};
}

/** Whether a file may hold the voxels of another image in its folder: whether a header there, other than that one, has
 * its name or names files by a pattern or a list. One that cannot be read might. */
bool
IsNamedByAnother(const fs::path & data, const fs::path & header)
{
  for (const fs::directory_entry & entry : fs::directory_iterator(data.parent_path()))
  {
    const std::string ending = ToLower(entry.path().extension().string());
    std::error_code   error;
    if (entry.path() == header || !entry.is_regular_file(error) ||
        (ending != ".mhd" && ending != ".nhdr" && ending != ".mha" && ending != ".nrrd"))
    {
      continue;
    }
    try
    {
      const std::string name = ReadDataName(entry.path());
      if (fs::path(name).filename() == data.filename() || name.rfind("LIST", 0) == 0 ||
          name.find('%') != std::string::npos)
      {
        return true;
      }
    }
    catch (const std::runtime_error &)
    {
      return true;
    }
  }
  return false;
}
} // namespace

bool
IsPlainFormat(const fs::path & output)
{
  const std::string ending = ToLower(output.extension().string());
  return ending == ".mha" || ending == ".mhd" || ending == ".nrrd" || ending == ".nhdr";
}

PlainHeader
ComposePlainHeader(const fs::path & output, const ImageDescription & description, const OutputOptions & options)
{
  PlainHeader       header;
  const std::string ending = ToLower(output.extension().string());
  header.IsNrrd = IsNrrd(output);
  header.IsDetached = ending == ".mhd" || ending == ".nhdr";
  header.DataName = header.IsDetached ? GetDataName(output, options.Compress) : "";
  const auto style = header.IsNrrd ? MetadataStyle::Nrrd : MetadataStyle::MetaImage;
  const auto metadata = SelectMetadata(description, style, options.KeepMetadata);
  // A name that starts with LIST would mean a list of names.
  std::string name = header.IsDetached ? header.DataName : header.IsNrrd ? "" : "LOCAL";
  name = header.IsDetached && name.rfind("LIST", 0) == 0 ? "./" + name : name;
  header.Text = header.IsNrrd ? ComposeNrrdHeader(description, metadata, name, options.Compress)
                              : ComposeMetaHeader(description, metadata, name, options.Compress);
  return header;
}

void
CheckDataFile(const fs::path & output, const std::string & dataName)
{
  const fs::path  data = output.parent_path() / dataName;
  std::error_code error;
  if (fs::exists(fs::symlink_status(data, error)) && ReadDataName(output) != dataName)
  {
    Fail(output.string(), "its voxels would replace the file " + data.string() + ", which is another image's");
  }
}

std::optional<fs::path>
FindOldDataFile(const fs::path & output, const bool isCompressed)
{
  const fs::path  data = output.parent_path() / GetDataName(output, !isCompressed);
  std::error_code error;
  const bool      isOld = ReadDataName(output) == data.filename().string() &&
                     fs::is_regular_file(fs::symlink_status(data, error)) && !IsNamedByAnother(data, output);
  return isOld ? std::optional<fs::path>(data) : std::nullopt;
}

void
CheckPlainFile(const std::string & file, const std::string & meant, const ImageDescription & description)
{
  try
  {
    const PlainLayout layout = IsNrrd(file) ? ReadNrrdHeader(file) : ReadMetaHeader(file);
    if (layout.Description.Grid.Size == description.Grid.Size &&
        layout.Description.GetVoxelBytes() == description.GetVoxelBytes())
    {
      return;
    }
  }
  catch (const std::runtime_error & error)
  {
    Fail(meant, std::string("it is not whole: ") + error.what());
  }
  Fail(meant, "its header is not what was meant");
}
