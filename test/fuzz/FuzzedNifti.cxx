// SPDX-License-Identifier: Apache-2.0
#include "FuzzedFiles.h"
#include "FuzzedNiftiFiles.h"
#include "FuzzedNiftiHeader.h"

#include "itk/FileLength.h"
#include "nifti/NiftiFiles.h"
#include "nifti/NiftiHeader.h"
#include "nifti/NiftiReader.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using itk::Subdivision::ElementType;

namespace
{
bool
IsOfKind(const FuzzedNiftiHeader & header)
{
  return header.IsSingle() || GetBits(header.Text, header.IsBig, 0, 4) == FuzzedNiftiHeader::Size;
}

/** Whether numbers that are rescaled to single precision neither vanish there nor become infinite. */
bool
FitsSinglePrecision(const FuzzedNiftiHeader & header)
{
  const auto                    rescaling = header.GetRescaling();
  const FuzzedNiftiType * const type = header.FindType();
  if (!rescaling || type == nullptr || type->Component == ElementType::Double || !std::isfinite(rescaling->first) ||
      !std::isfinite(rescaling->second) || std::isnan(header.Real(112)) || std::isnan(header.Real(116)))
  {
    return true;
  }
  const bool isSigned = type->Component == ElementType::Int8 || type->Component == ElementType::Int16 ||
                        type->Component == ElementType::Int32 || type->Component == ElementType::Int64;
  const int    bits = static_cast<int>(8 * itk::Subdivision::SizeOf(type->Component)) - (isSigned ? 1 : 0);
  const double largest = type->Component == ElementType::Float ? 1.0 : std::ldexp(1.0, bits) - 1.0;
  const double slope = std::abs(rescaling->first);
  const double mostOfSingle = std::ldexp(2.0 - std::ldexp(1.0, -23), 127);
  return slope >= std::ldexp(1.0, -126) && largest * slope + std::abs(rescaling->second) <= mostOfSingle;
}

/** Whether the components are as many as its kind of voxels has, single numbers, and the last axis that counts. */
bool
HasRightComponents(const FuzzedNiftiHeader & header)
{
  const unsigned                axes = header.Short(40);
  const unsigned                components = axes < 5 ? 1 : header.Short(50);
  const auto                    root = static_cast<unsigned>(std::sqrt(2.0 * components));
  const bool                    isTriangle = components < 32768 && root * (root + 1) == 2 * components;
  const FuzzedNiftiType * const type = header.FindType();
  const bool                    isLonger = (axes >= 6 && header.Short(52) != 1) || (axes == 7 && header.Short(54) != 1);
  const bool isOther = header.Short(68) != 1005 && header.Short(68) != 1006 && header.Short(68) != 1007;
  return !header.IsNifti() || isOther ||
         ((type == nullptr || type->Components == 1) && !isLonger && (header.Short(68) != 1005 || isTriangle));
}

/** Whether no axis in space has voxels of a negative length. */
bool
HasRightLengths(const FuzzedNiftiHeader & header)
{
  const unsigned axes = header.Short(40);
  return !(header.Real(80) < 0.0) && !(axes >= 2 && header.Real(84) < 0.0) && !(axes >= 3 && header.Real(88) < 0.0);
}

/** Whether the files are what their header says. */
bool
IsRight(const FuzzedNiftiFiles & files, const FuzzedNiftiHeader & header)
{
  const bool hasRightMagic = header.IsSingle() != files.IsPair && (header.IsNifti() || header.Text[344] != 'n');
  const bool startsInHeader = header.IsSingle() && header.GetOffset() < 352.0;
  const bool hasOddIntercept =
    header.IsNifti() && header.Real(112) == 0.0 && header.Real(116) != 0.0 && std::isfinite(header.Real(116));
  const double                  bytes = header.GetVoxelBytes();
  const FuzzedNiftiType * const type = header.FindType();
  const bool                    hasBitsOfType =
    type == nullptr || header.Short(72) == 8 * type->Components * itk::Subdivision::SizeOf(type->Component);
  return hasRightMagic && hasBitsOfType && !startsInHeader && !hasOddIntercept && HasRightComponents(header) &&
         FitsSinglePrecision(header) && bytes > 0.0 &&
         static_cast<double>(files.Voxels.size()) == header.GetOffset() + bytes;
}

/** The image as ITK describes it, if its voxels are numbers of one of the types and it has up to four axes, and
 * components where it has five. */
std::optional<ImageDescription>
Describe(const FuzzedNiftiHeader & header)
{
  const FuzzedNiftiType * const type = header.FindType();
  const unsigned                axes = header.Short(40);
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
    header.GetRescaling() && itk::Subdivision::IsInteger(type->Component) ? ElementType::Float : type->Component;
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
CheckVoxels(const FuzzedNiftiFiles &  files,
            const FuzzedNiftiHeader & header,
            const ImageDescription &  description,
            const char *              voxels)
{
  const ElementType stored = header.FindType()->Component;
  const std::size_t size = itk::Subdivision::SizeOf(stored);
  const std::size_t meantSize = itk::Subdivision::SizeOf(description.Component);
  const std::size_t components = description.NumberOfComponents;
  const std::size_t count = description.GetNumberOfVoxels();
  const auto        rescaling = header.GetRescaling();
  for (std::size_t i = 0; i < count * components; ++i)
  {
    // The components of vectors have volumes of their own.
    const bool          isVector = description.Kind == VoxelKind::Vector;
    const std::size_t   place = isVector ? i % components * count + i / components : i;
    const std::uint64_t bits =
      GetBits(files.Voxels, header.IsBig, static_cast<std::size_t>(header.GetOffset()) + place * size, size);
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
CheckPlacement(const NiftiHeader & header, const ImageDescription & description, const bool hasRightLengths)
{
  ImageGrid grid = description.Grid;
  header.CompleteUnits(grid);
  const NiftiPlacement placement = header.GetPlacement();
  FuzzExpect(!placement.IsTwice() || placement.IsThere(), "a header that places its voxels twice and not at all");
  const std::string name = placement.GetName(grid);
  FuzzExpect(name == "sform" || name == "qform", "a placement that is none");
  FuzzExpect(placement.IsFinite() || placement.IsThere(), "a placement that is none is not finite");
  FuzzExpect(placement.FindFault().empty() ? hasRightLengths : (!hasRightLengths || placement.IsThere()),
             "voxels of a negative length, or a placement that is none has a fault");
  FuzzExpect(header.FindSpmParts().empty() || !placement.IsThere(), "a header of Analyze places its voxels");
  const std::size_t axes = grid.Size.size();
  FuzzExpect(axes < 3 || !(placement.LeavesAxes(axes) || placement.LiesBeside(axes)), "a volume has no place in space");
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
  const auto files = MakeNiftiFiles(bytes, folder);
  // A file that begins as a stream of gzip is taken for one, whatever its name.
  const auto isStream = [](const std::string & text) { return text.compare(0, 2, "\x1f\x8b") == 0; };
  if (!files || isStream(files->Voxels) || isStream(files->HeaderText))
  {
    return;
  }
  const FuzzedNiftiHeader header(files->HeaderText);
  const NiftiPair names = IsNiftiPair(files->Path) ? FindNiftiPair(files->Path) : NiftiPair{ files->Path, files->Path };
  const NiftiHeader found(names.Header);
  const bool        isRefused = IsRefused([&] { CheckNiftiLength(files->Path); });
  const bool        isOfKind = header.IsSane && IsOfKind(header);
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
  CheckPlacement(found, *description, HasRightLengths(header));
  const auto reader = OpenPlainNifti(found, names, *description);
  const bool isLeft = !files->HasPlainVoxels || header.Short(68) == 1006 || header.GetOffset() != header.Real(108) ||
                      (rescaling && header.FindType()->Components > 1);
  FuzzExpect((reader == nullptr) == isLeft, "plain voxels are left to the library, or the other way round");
  if (reader != nullptr)
  {
    itk::Subdivision::Box all;
    for (const std::uint64_t size : description->Grid.Size)
    {
      all.push_back({ 0, size });
    }
    std::vector<char> voxels(description->GetBytes());
    reader->Read(all, voxels.data());
    CheckVoxels(*files, header, *description, voxels.data());
    FuzzBytes places(choices, sizeof(choices));
    CheckPart(places, *reader, voxels);
  }
}
