// SPDX-License-Identifier: Apache-2.0
#include "PlainHeader.h"
#include "DataOwners.h"
#include "HeaderText.h"
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
  if (!fs::exists(fs::symlink_status(data, error)))
  {
    return;
  }
  const bool isOwn = ReadDataName(output) == dataName;
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
  const fs::path  data = output.parent_path() / GetDataName(output, !isCompressed);
  std::error_code error;
  const bool      isOld = ReadDataName(output) == data.filename().string() &&
                     fs::is_regular_file(fs::symlink_status(data, error)) && !FindOtherOwner(data, output);
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
