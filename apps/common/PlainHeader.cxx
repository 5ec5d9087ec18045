// SPDX-License-Identifier: Apache-2.0
#include "PlainHeader.h"
#include "HeaderText.h"
#include "InputFile.h"
#include "MetaHeader.h"
#include "Metadata.h"
#include "NrrdHeader.h"

#include <algorithm>
#include <random>
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

/** The parts of a data file's name between which an interim one has six letters and digits. */
std::pair<std::string, std::string>
SplitDataName(const std::string & dataName)
{
  constexpr std::size_t longest = 255;
  constexpr const char  mark[] = ".new-";
  for (const std::string ending : { ".raw.gz", ".zraw", ".raw" })
  {
    if (dataName.size() > ending.size() &&
        dataName.compare(dataName.size() - ending.size(), ending.size(), ending) == 0)
    {
      const std::size_t room = longest - sizeof(mark) + 1 - 6 - ending.size();
      return { dataName.substr(0, std::min(dataName.size() - ending.size(), room)) + mark, ending };
    }
  }
  return { dataName + mark, "" };
}

bool
IsInterimDataName(const std::string & name, const std::string & dataName)
{
  const auto [start, ending] = SplitDataName(dataName);
  return name.size() == start.size() + 6 + ending.size() && name.compare(0, start.size(), start) == 0 &&
         name.compare(name.size() - ending.size(), ending.size(), ending) == 0 &&
         name.find('/', start.size()) == std::string::npos;
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

std::string
MakeInterimDataName(const fs::path & folder, const std::string & dataName)
{
  constexpr char     characters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
  std::random_device random;
  const auto [start, ending] = SplitDataName(dataName);
  std::string     name;
  std::error_code error;
  do
  {
    name = start;
    for (int i = 0; i < 6; ++i)
    {
      name += characters[random() % (sizeof(characters) - 1)];
    }
    name += ending;
  } while (fs::exists(fs::symlink_status(folder / name, error)));
  return name;
}

bool
IsPlainFormat(const fs::path & output)
{
  const std::string ending = ToLower(output.extension().string());
  return ending == ".mha" || ending == ".mhd" || ending == ".nrrd" || ending == ".nhdr";
}

PlainHeader
ComposePlainHeader(const fs::path &         output,
                   const ImageDescription & description,
                   const OutputOptions &    options,
                   const std::string &      dataName)
{
  PlainHeader       header;
  const std::string ending = ToLower(output.extension().string());
  header.IsNrrd = IsNrrd(output);
  header.IsDetached = ending == ".mhd" || ending == ".nhdr";
  header.DataName = !header.IsDetached ? "" : dataName.empty() ? GetDataName(output, options.Compress) : dataName;
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
  if (!fs::exists(fs::symlink_status(data, error)))
  {
    return;
  }
  const std::string named = ReadDataName(output);
  // A run that was killed may have left the header with an interim name, beside the data that it replaced.
  if (named != dataName && (!IsInterimDataName(named, dataName) || IsNamedByAnother(data, output)))
  {
    Fail(output.string(), "its voxels would replace the file " + data.string() + ", which is another image's");
  }
}

std::optional<fs::path>
FindOldDataFile(const fs::path & output, const bool isCompressed)
{
  const std::string named = ReadDataName(output);
  const std::string other = GetDataName(output, !isCompressed);
  const bool        isOwn =
    named == other || IsInterimDataName(named, other) || IsInterimDataName(named, GetDataName(output, isCompressed));
  const fs::path  data = output.parent_path() / named;
  std::error_code error;
  const bool isOld = isOwn && fs::is_regular_file(fs::symlink_status(data, error)) && !IsNamedByAnother(data, output);
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
