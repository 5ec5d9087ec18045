// SPDX-License-Identifier: Apache-2.0
#include "FuzzedFiles.h"

#include "itk/FileLength.h"
#include "nifti/NiftiFiles.h"
#include "nifti/NiftiHeader.h"
#include "nifti/NiftiReader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <zlib.h>

using itk::Subdivision::ElementType;

namespace
{
constexpr std::size_t HeaderSize = 348;
constexpr double      MostBytes = 1 << 16;

/** What the header says of a type of voxels. */
struct Type
{
  int         Code;
  ElementType Component;
  unsigned    Components;
  VoxelKind   Kind;
};
constexpr Type Types[] = {
  { 2, ElementType::UInt8, 1, VoxelKind::Scalar },      { 4, ElementType::Int16, 1, VoxelKind::Scalar },
  { 8, ElementType::Int32, 1, VoxelKind::Scalar },      { 16, ElementType::Float, 1, VoxelKind::Scalar },
  { 32, ElementType::Float, 2, VoxelKind::Complex },    { 64, ElementType::Double, 1, VoxelKind::Scalar },
  { 128, ElementType::UInt8, 3, VoxelKind::Rgb },       { 256, ElementType::Int8, 1, VoxelKind::Scalar },
  { 512, ElementType::UInt16, 1, VoxelKind::Scalar },   { 768, ElementType::UInt32, 1, VoxelKind::Scalar },
  { 1024, ElementType::Int64, 1, VoxelKind::Scalar },   { 1280, ElementType::UInt64, 1, VoxelKind::Scalar },
  { 1792, ElementType::Double, 2, VoxelKind::Complex }, { 2304, ElementType::UInt8, 4, VoxelKind::Rgba }
};

template <typename T>
T
FromBits(const std::uint64_t bits)
{
  using Bits = std::conditional_t<sizeof(T) == 1,
                                  std::uint8_t,
                                  std::conditional_t<sizeof(T) == 2,
                                                     std::uint16_t,
                                                     std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;
  const auto low = static_cast<Bits>(bits);
  T          number;
  std::memcpy(&number, &low, sizeof(number));
  return number;
}

/** A number as it stands in a file. */
std::uint64_t
GetBits(const std::string & text, const bool isBig, const std::size_t place, const std::size_t size)
{
  const std::string number = text.substr(place, size);
  return GetLittleEndian(isBig ? std::string(number.rbegin(), number.rend()) : number, 0, size);
}

/** The header, number by number, by the places that the format's definition says. */
struct Header
{
  explicit Header(const std::string & text)
    : Text(text)
  {
    IsWhole = text.size() >= HeaderSize;
    Text.resize(HeaderSize);
    const auto isCount = [](std::uint64_t number) { return number >= 1 && number <= 7; };
    IsBig = isCount(GetBits(Text, true, 40, 2));
    IsSane = IsWhole && (IsBig || isCount(GetBits(Text, false, 40, 2)));
    Slope = this->Real(112);
    Intercept = this->Real(116);
  }

  unsigned
  Short(const std::size_t place) const
  {
    return static_cast<unsigned>(GetBits(Text, IsBig, place, 2));
  }
  float
  Real(const std::size_t place) const
  {
    return FromBits<float>(GetBits(Text, IsBig, place, 4));
  }
  const Type *
  FindType() const
  {
    const auto * const found = std::find_if(std::begin(Types), std::end(Types), [&](const Type & type) {
      return type.Code == static_cast<int>(this->Short(70));
    });
    return found == std::end(Types) ? nullptr : found;
  }
  bool
  IsNifti() const
  {
    return Text[344] == 'n';
  }

  std::string Text;
  bool        IsWhole = false;
  bool        IsBig = false;
  bool        IsSane = false;
  double      Slope = 0.0;
  double      Intercept = 0.0;
};

/** Bytes before the voxels and with them, as real numbers, which do not overflow. */
double
GetOffset(const Header & header)
{
  const float offset = header.Real(108);
  return offset >= 0.0f && offset < 1e15f ? std::floor(static_cast<double>(offset)) : 0.0;
}

double
GetVoxelBytes(const Header & header)
{
  double bits = header.Short(72);
  for (unsigned axis = 1; axis <= header.Short(40); ++axis)
  {
    bits *= header.Short(40 + 2 * axis);
  }
  return std::floor(bits / 8.0);
}

/** The files of an image, as they are without compression. */
struct Files
{
  std::string Path; // by which it is opened
  bool        IsPair = false;
  bool        HasPlainVoxels = true;
  std::string HeaderText;
  std::string Voxels; // with what precedes them in their file
};

/** Takes a file to the length that its header says, if that is not much. */
void
Fit(Files & files)
{
  const Header header(files.HeaderText);
  const double length = header.IsSane ? GetOffset(header) + GetVoxelBytes(header) : 0.0;
  if (!header.IsSane || length > MostBytes || (!files.IsPair && length < HeaderSize))
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

/** A single file or a pair, each compressed or not, opened by the name of either. */
std::optional<Files>
MakeFiles(FuzzBytes & bytes, const FuzzFolder & folder)
{
  const unsigned int form = bytes.Below(6);
  const bool         isFitted = bytes.Below(2) != 0;
  std::string        text = bytes.Rest();
  Files              files;
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
    files.HeaderText = text.substr(0, HeaderSize);
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

bool
IsOfKind(const Files & files, const Header & header)
{
  return files.IsPair ? GetBits(header.Text, header.IsBig, 0, 4) == HeaderSize
                      : header.Text.compare(344, 3, "n+1") == 0;
}

/** Whether the files are what their header says. */
bool
IsRight(const Files & files, const Header & header)
{
  const bool startsInHeader = header.Text.compare(344, 3, "n+1") == 0 && GetOffset(header) < 352.0;
  const bool hasOddIntercept =
    header.IsNifti() && header.Slope == 0.0 && header.Intercept != 0.0 && std::isfinite(header.Intercept);
  const double       bytes = GetVoxelBytes(header);
  const Type * const type = header.FindType();
  const bool         hasBitsOfType =
    type == nullptr || header.Short(72) == 8 * type->Components * itk::Subdivision::SizeOf(type->Component);
  return hasBitsOfType && !startsInHeader && !hasOddIntercept && bytes > 0.0 &&
         static_cast<double>(files.Voxels.size()) == GetOffset(header) + bytes;
}

/** Slope and intercept, where there are any that change something. */
std::optional<std::pair<double, double>>
GetRescaling(const Header & header)
{
  const double least = std::ldexp(1.0, -52);
  const double slope = std::isnan(header.Slope) || std::abs(header.Slope) < least ? 1.0 : header.Slope;
  const double intercept = std::isnan(header.Intercept) ? 0.0 : header.Intercept;
  return header.IsNifti() && (slope != 1.0 || std::abs(intercept) > least)
           ? std::make_optional(std::make_pair(slope, intercept))
           : std::nullopt;
}

/** The image as ITK describes it, if its voxels are numbers of one of the types and it has up to four axes, and
 * components where it has five. */
std::optional<ImageDescription>
Describe(const Header & header)
{
  const Type * const type = header.FindType();
  const unsigned     axes = header.Short(40);
  if (type == nullptr || axes > 5 || (axes == 5 && type->Components > 1))
  {
    return std::nullopt;
  }
  ImageDescription description;
  for (unsigned axis = 1; axis <= axes; ++axis)
  {
    const unsigned size = header.Short(40 + 2 * axis);
    if (size < 1 || size > 32767)
    {
      return std::nullopt;
    }
    if (axis < 5)
    {
      description.Grid.Size.push_back(size);
      description.Grid.Spacing.push_back(1.0);
      description.Grid.Origin.push_back(0.0);
    }
  }
  for (std::size_t axis = 0; axis < description.Grid.Size.size(); ++axis)
  {
    description.Grid.Directions.emplace_back(description.Grid.Size.size(), 0.0);
    description.Grid.Directions.back()[axis] = 1.0;
  }
  description.Format = "NIfTI";
  description.NumberOfComponents = axes == 5 ? header.Short(50) : type->Components;
  description.Kind = axes == 5 && description.NumberOfComponents > 1 ? VoxelKind::Vector : type->Kind;
  description.Component =
    GetRescaling(header) && itk::Subdivision::IsInteger(type->Component) ? ElementType::Float : type->Component;
  return description;
}

/** Whether a number of a voxel is the stored one, rescaled where the header says so. Beyond that, the last digit is
 * that of the compiler, which may round once or twice. */
template <typename TStored>
bool
IsMeant(TStored stored, const char * const bytes, const std::optional<std::pair<double, double>> & rescaling)
{
  using Meant = std::conditional_t<std::is_floating_point_v<TStored>, TStored, float>;
  if constexpr (std::is_floating_point_v<TStored>)
  {
    stored = std::isfinite(stored) ? stored : TStored{ 0 };
  }
  if (!rescaling)
  {
    return std::memcmp(&stored, bytes, sizeof(stored)) == 0;
  }
  Meant meant{};
  std::memcpy(&meant, bytes, sizeof(meant));
  const double single = static_cast<Meant>(stored);
  const double product = single * rescaling->first;
  const double largest = std::abs(product) + std::abs(rescaling->second);
  const auto   expected = static_cast<Meant>(product + rescaling->second);
  return meant == expected || std::abs(static_cast<double>(meant) - static_cast<double>(expected)) <=
                                2.0 * std::numeric_limits<Meant>::epsilon() * largest;
}

void
CheckVoxels(const Files & files, const Header & header, const ImageDescription & description, const char * voxels)
{
  const ElementType stored = header.FindType()->Component;
  const std::size_t size = itk::Subdivision::SizeOf(stored);
  const std::size_t meantSize = itk::Subdivision::SizeOf(description.Component);
  const std::size_t components = description.NumberOfComponents;
  const std::size_t count = description.GetNumberOfVoxels();
  const auto        rescaling = GetRescaling(header);
  for (std::size_t i = 0; i < count * components; ++i)
  {
    // The components of vectors have volumes of their own.
    const bool          isVector = description.Kind == VoxelKind::Vector;
    const std::size_t   place = isVector ? i % components * count + i / components : i;
    const std::uint64_t bits =
      GetBits(files.Voxels, header.IsBig, static_cast<std::size_t>(GetOffset(header)) + place * size, size);
    const bool isMeant = itk::Subdivision::WithElementType(stored, [&](auto tag) {
      return IsMeant(FromBits<typename decltype(tag)::Type>(bits), voxels + i * meantSize, rescaling);
    });
    FuzzExpect(isMeant, "a voxel of NIfTI is not what its bytes mean");
  }
}

/** A part is the whole's part. */
void
CheckPart(FuzzBytes & choices, VolumeReader & reader, const std::vector<char> & voxels)
{
  const auto &          size = reader.GetDescription().Grid.Size;
  const std::size_t     voxelBytes = reader.GetDescription().GetVoxelBytes();
  itk::Subdivision::Box box;
  std::size_t           count = 1;
  for (const std::uint64_t axis : size)
  {
    const std::uint64_t first = choices.UpTo(axis - 1);
    box.push_back({ static_cast<std::int64_t>(first), 1 + choices.UpTo(axis - 1 - first) });
    count *= box.back().Size;
  }
  std::vector<char> part(count * voxelBytes);
  reader.Read(box, part.data());
  for (std::size_t i = 0; i < count; ++i)
  {
    std::size_t place = 0;
    std::size_t stride = 1;
    std::size_t rest = i;
    for (std::size_t axis = 0; axis < size.size(); ++axis)
    {
      place += stride * (static_cast<std::size_t>(box[axis].First) + rest % box[axis].Size);
      rest /= box[axis].Size;
      stride *= size[axis];
    }
    FuzzExpect(std::memcmp(&part[i * voxelBytes], &voxels[place * voxelBytes], voxelBytes) == 0,
               "a part of NIfTI voxels is not the whole's");
  }
}

/** What the header says besides its voxels. */
void
CheckPlacement(const NiftiHeader & header, const ImageDescription & description)
{
  ImageGrid grid = description.Grid;
  header.CompleteUnits(grid);
  FuzzExpect(!header.IsPlacedTwice() || header.IsPlaced(), "a header that places its voxels twice and not at all");
  const std::string placement = header.GetPlacement(grid);
  FuzzExpect(placement == "sform" || placement == "qform", "a placement that is none");
  FuzzExpect(header.IsPlacedFinitely() || header.IsPlaced(), "a placement that is none is not finite");
}
} // namespace

/** The voxels of files that are accepted are those that are there. */
void
FuzzNifti(FuzzBytes & bytes, const FuzzFolder & folder)
{
  std::uint8_t choices[16];
  for (std::uint8_t & choice : choices)
  {
    choice = bytes.Byte();
  }
  const auto files = MakeFiles(bytes, folder);
  // A file that begins as a stream of gzip is taken for one, whatever its name.
  const auto isStream = [](const std::string & text) { return text.compare(0, 2, "\x1f\x8b") == 0; };
  if (!files || isStream(files->Voxels) || isStream(files->HeaderText))
  {
    return;
  }
  const Header    header(files->HeaderText);
  const NiftiPair names = IsNiftiPair(files->Path) ? FindNiftiPair(files->Path) : NiftiPair{ files->Path, files->Path };
  const NiftiHeader found(names.Header);
  const bool        isRefused = IsRefused([&] { CheckNiftiLength(files->Path); });
  const bool        isOfKind = header.IsSane && IsOfKind(*files, header);
  FuzzExpect(!header.IsSane || isRefused == (isOfKind && !IsRight(*files, header)),
             "a NIfTI file that is right is refused, or the other way round");
  FuzzExpect(!header.IsSane || found.IsBigEndian() == header.IsBig, "another byte order than the header's");
  const auto description = Describe(header);
  const auto rescaling = found.GetRescaling();
  const bool isFinite = !rescaling || (std::isfinite(rescaling->first) && std::isfinite(rescaling->second));
  if (isRefused || !isOfKind || !description || !isFinite)
  {
    return;
  }
  CheckPlacement(found, *description);
  const auto reader = OpenPlainNifti(found, names, *description);
  const bool isLeft = !files->HasPlainVoxels || header.Short(68) == 1006 || GetOffset(header) != header.Real(108) ||
                      (rescaling && header.FindType()->Components > 1);
  FuzzExpect((reader == nullptr) == isLeft, "plain voxels are left to the library, or the other way round");
  if (reader != nullptr)
  {
    itk::Subdivision::Box all;
    for (const std::uint64_t size : description->Grid.Size)
    {
      all.push_back({ 0, size });
    }
    std::vector<char> voxels(description->GetNumberOfVoxels() * description->GetVoxelBytes());
    reader->Read(all, voxels.data());
    CheckVoxels(*files, header, *description, voxels.data());
    FuzzBytes places(choices, sizeof(choices));
    CheckPart(places, *reader, voxels);
  }
}
