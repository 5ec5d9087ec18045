// SPDX-License-Identifier: Apache-2.0
#include "headers/PlainHeader.h"
#include "headers/DataOwners.h"
#include "headers/MetaHeader.h"
#include "headers/Metadata.h"
#include "headers/NrrdHeader.h"
#include "text/HeaderText.h"

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

bool
IsDetached(const fs::path & output)
{
  const std::string ending = ToLower(output.extension().string());
  return ending == ".mhd" || ending == ".nhdr";
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
} // namespace

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
  PlainHeader header;
  header.IsNrrd = IsNrrd(output);
  header.IsDetached = IsDetached(output);
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
  const bool isOwn = named == dataName || IsInterimDataName(named, dataName);
  const auto other = isOwn ? FindOtherOwner(data, output) : std::nullopt;
  if (!isOwn || other)
  {
    Fail(output.string(),
         "its voxels would replace the file " + data.string() + ", which is another image's" +
           (other ? ", too, that of " + other->string() : "") + "; choose another name");
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
  const bool isOld = isOwn && fs::is_regular_file(fs::symlink_status(data, error)) && !FindOtherOwner(data, output);
  return isOld ? std::optional<fs::path>(data) : std::nullopt;
}

std::vector<fs::path>
ListReplacedFiles(const fs::path & output, const bool isCompressed)
{
  std::vector<fs::path> files = { output };
  if (IsDetached(output))
  {
    files.push_back(output.parent_path() / GetDataName(output, isCompressed));
    if (const auto old = FindOldDataFile(output, isCompressed))
    {
      files.push_back(*old);
    }
  }
  return files;
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
