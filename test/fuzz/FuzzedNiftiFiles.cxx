// SPDX-License-Identifier: Apache-2.0
#include "FuzzedNiftiFiles.h"
#include "FuzzedFiles.h"
#include "FuzzedNiftiHeader.h"

#include "itk/FileLength.h"
#include "nifti/NiftiFiles.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <zlib.h>

namespace
{
constexpr double MostBytes = 1 << 16;

/** Takes a file to the length that its header says, if that is not much. */
void
Fit(FuzzedNiftiFiles & files)
{
  const FuzzedNiftiHeader header(files.HeaderText);
  const double            length = header.IsSane ? header.GetOffset() + header.GetVoxelBytes() : 0.0;
  if (!header.IsSane || length > MostBytes || (!files.IsPair && length < FuzzedNiftiHeader::Size))
  {
    return;
  }
  std::size_t i = files.Voxels.size();
  files.Voxels.resize(static_cast<std::size_t>(length));
  for (; i < files.Voxels.size(); ++i)
  {
    files.Voxels[i] = static_cast<char>((i * 0x9e3779b1u >> 20) & 0xff);
  }
  files.HeaderText = files.IsPair ? files.HeaderText : files.Voxels;
}

void
WriteFile(const FuzzFolder & folder, const std::string & name, const std::string & text, const bool isCompressed)
{
  if (!isCompressed)
  {
    folder.Write(name, text);
    return;
  }
  const gzFile file = gzopen(folder.GetPath(name).c_str(), "wb1");
  FuzzExpect(file != nullptr &&
               gzwrite(file, text.data(), static_cast<unsigned>(text.size())) == static_cast<int>(text.size()) &&
               gzclose(file) == Z_OK,
             "a file cannot be written");
}

/** What a stream of gzip holds, if it is a single whole one and holds little. */
std::optional<std::string>
Inflate(std::string stream)
{
  z_stream zlib = {};
  inflateInit2(&zlib, 16 + MAX_WBITS);
  std::string text(static_cast<std::size_t>(MostBytes), '\0');
  zlib.next_in = reinterpret_cast<unsigned char *>(stream.data());
  zlib.avail_in = static_cast<unsigned>(stream.size());
  zlib.next_out = reinterpret_cast<unsigned char *>(text.data());
  zlib.avail_out = static_cast<unsigned>(text.size());
  const bool isWhole = inflate(&zlib, Z_FINISH) == Z_STREAM_END && zlib.avail_in == 0;
  text.resize(zlib.total_out);
  inflateEnd(&zlib);
  return isWhole ? std::make_optional(text) : std::nullopt;
}
} // namespace

std::optional<FuzzedNiftiFiles>
MakeNiftiFiles(FuzzBytes & bytes, const FuzzFolder & folder)
{
  const unsigned int form = bytes.Below(6);
  const bool         isFitted = bytes.Below(2) != 0;
  std::string        text = bytes.Rest();
  FuzzedNiftiFiles   files;
  if (form == 0 || form == 1)
  {
    files.HeaderText = files.Voxels = text;
    files.HasPlainVoxels = form == 0;
    files.Path = folder.GetPath(form == 0 ? "single.nii" : "packed.nii.gz");
  }
  else if (form == 2) // a stream of the fuzzer's own
  {
    files.Path = folder.Write("stream.nii.gz", text);
    files.HasPlainVoxels = false;
    const auto inflated = Inflate(text);
    if (!inflated)
    {
      IsRefused([&] { CheckNiftiLength(files.Path); });
      return std::nullopt;
    }
    files.HeaderText = files.Voxels = *inflated;
    return files;
  }
  else
  {
    const char * const names[] = { "pair.hdr", "packed.img.gz", "mixed.img.gz" };
    files.IsPair = true;
    files.HeaderText = text.substr(0, FuzzedNiftiHeader::Size);
    files.Voxels = text.substr(files.HeaderText.size());
    files.HasPlainVoxels = form == 3;
    files.Path = folder.GetPath(names[form - 3]);
  }
  if (isFitted)
  {
    Fit(files);
  }
  if (!files.IsPair)
  {
    WriteFile(folder, form == 0 ? "single.nii" : "packed.nii.gz", files.Voxels, form == 1);
    return files;
  }
  const std::string stem = form == 3 ? "pair" : form == 4 ? "packed" : "mixed";
  WriteFile(folder, stem + (form == 4 ? ".hdr.gz" : ".hdr"), files.HeaderText, form == 4);
  WriteFile(folder, stem + (form == 3 ? ".img" : ".img.gz"), files.Voxels, form != 3);
  return files;
}

/** What the names of a pair and of what is beside it have to do with each other. Those that are in both cases are
 * refused before any of this is asked. */
void
FuzzNiftiNames(FuzzBytes & bytes)
{
  constexpr const char * endings[] = { ".hdr", ".img", ".HDR", ".IMG", ".hdr.gz", ".img.gz", ".HDR.GZ", ".IMG.GZ", "" };
  const std::string      ending = endings[bytes.Below(std::size(endings))];
  const std::string      name = bytes.Rest() + ending;
  // A folder of the name, or an end of it, is another matter.
  if (name.find_first_of(std::string("/\0", 2)) != std::string::npos)
  {
    return;
  }
  const std::vector<std::filesystem::path> other = ListOtherPair(name);
  FuzzExpect(other.size() == (IsNiftiPair(name) ? 2 : 0), "other files of what is no pair, or none of a pair");
  IsRefused([&] { GetMistakenNiftiEnding("/nowhere/" + name); });
  IsRefused([&] { FindNiftiPair("/nowhere/" + name); });
  if (!IsNiftiPair(name) || HasNiftiEndingInMixedCase(name))
  {
    return;
  }
  const std::vector<std::filesystem::path> written = ListWrittenPair(name);
  FuzzExpect(std::find(written.begin(), written.end(), name) != written.end(),
             "a pair that does not have its own name");
  FuzzExpect(written.size() == 2 && written[0] != written[1], "a pair that is not two files");
  for (std::size_t i = 0; i < 2; ++i)
  {
    FuzzExpect(IsNiftiPair(written[i].string()) && ListWrittenPair(written[i].string()) == written,
               "a file of a pair that is none of its own");
    FuzzExpect(IsNiftiPair(other[i].string()) && other[i] != written[i] &&
                 ListOtherPair(other[i].string())[i] == written[i],
               "the other file of a pair that is none of it");
  }
}
