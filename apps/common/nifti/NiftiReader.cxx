// SPDX-License-Identifier: Apache-2.0
#include "nifti/NiftiReader.h"
#include "plain/PlainReader.h"
#include "system/files/InputFile.h"
#include "text/HeaderText.h"

#include <cmath>
#include <type_traits>
#include <vector>

using itk::Subdivision::Box;
using itk::Subdivision::ElementType;
using itk::Subdivision::WithElementType;

namespace
{
using Rescaling = std::optional<std::pair<double, double>>;

/** Where the stored numbers are: those of vectors have each component in a volume of its own. */
PlainLayout
MakeLayout(const NiftiHeader & header, const std::string & voxels, const ImageDescription & description)
{
  PlainLayout layout;
  layout.Description = description;
  layout.Description.Component = *header.GetComponent();
  if (description.NumberOfComponents > 1 && header.CountComponentsSideBySide() == 1)
  {
    layout.Description.Grid.Size.push_back(description.NumberOfComponents);
    layout.Description.NumberOfComponents = 1;
  }
  const ImageDescription & stored = layout.Description;
  layout.Sections = { { voxels, header.GetDataOffset(), stored.GetBytes() } };
  layout.IsBigEndian = header.IsBigEndian();
  return layout;
}

/** ITK's library for NIfTI takes what is not finite for 0. */
template <typename T>
T
MakeFinite(T value)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return std::isfinite(value) ? value : T{ 0 };
  }
  return value;
}

/** What a stored number means; ITK rounds integers to single precision before and after they are rescaled. */
template <typename TMeant, typename TStored>
TMeant
Rescale(TStored value, const std::pair<double, double> & rescaling)
{
  const auto rounded = static_cast<TMeant>(MakeFinite(value));
  return static_cast<TMeant>(static_cast<double>(rounded) * rescaling.first + rescaling.second);
}

/** Integers that are rescaled are single precision numbers. */
ElementType
GetMeantType(ElementType stored, const Rescaling & rescaling)
{
  return rescaling && itk::Subdivision::IsInteger(stored) ? ElementType::Float : stored;
}

class NiftiReader : public VolumeReader
{
public:
  NiftiReader(const std::string &      header,
              const PlainLayout &      layout,
              const ImageDescription & description,
              const Rescaling &        rescaling)
    : m_Stored(header, layout)
    , m_Rescaling(rescaling)
  {
    m_Description = description;
    m_Description.Component = GetMeantType(layout.Description.Component, rescaling);
  }

  std::vector<std::string>
  GetFiles() const override
  {
    return m_Stored.GetFiles();
  }

  bool
  ReadsParts() const override
  {
    return true;
  }

  std::uint64_t
  GetScratchBytes(std::uint64_t partBytes) const override
  {
    const std::uint64_t stored = m_Stored.GetDescription().GetVoxelBytes();
    return this->IsReadAsStored() ? 0 : partBytes / m_Description.GetVoxelBytes() * stored;
  }

  void
  Read(const Box & box, void * voxels) override;

private:
  bool
  HasVolumeForEachComponent() const
  {
    return m_Stored.GetDescription().Grid.Size.size() > m_Description.Grid.Size.size();
  }

  bool
  IsReadAsStored() const
  {
    return !m_Rescaling && !this->HasVolumeForEachComponent();
  }

  PlainReader m_Stored;
  Rescaling   m_Rescaling;
};

void
NiftiReader::Read(const Box & box, void * voxels)
{
  std::uint64_t count = m_Stored.GetDescription().NumberOfComponents;
  for (const auto & interval : box)
  {
    count *= interval.Size;
  }
  const ElementType type = m_Stored.GetDescription().Component;
  const unsigned    volumes = this->HasVolumeForEachComponent() ? m_Description.NumberOfComponents : 1;
  std::vector<char> scratch(this->IsReadAsStored() ? 0 : count * itk::Subdivision::SizeOf(type));
  void * const      stored = this->IsReadAsStored() ? voxels : scratch.data();
  for (unsigned volume = 0; volume < volumes; ++volume)
  {
    Box part = box;
    if (this->HasVolumeForEachComponent())
    {
      part.push_back({ volume, 1 });
    }
    m_Stored.Read(part, stored);
    WithElementType(type, [&](auto tag) {
      using Stored = typename decltype(tag)::Type;
      using Meant = std::conditional_t<std::is_floating_point_v<Stored>, Stored, float>;
      const auto * const from = static_cast<const Stored *>(stored);
      for (std::uint64_t i = 0; m_Rescaling && i < count; ++i)
      {
        static_cast<Meant *>(voxels)[i * volumes + volume] = Rescale<Meant>(from[i], *m_Rescaling);
      }
      for (std::uint64_t i = 0; !m_Rescaling && i < count; ++i)
      {
        static_cast<Stored *>(voxels)[i * volumes + volume] = MakeFinite(from[i]);
      }
    });
  }
}
} // namespace

std::unique_ptr<VolumeReader>
OpenPlainNifti(const NiftiHeader & header, const NiftiPair & files, const ImageDescription & description)
{
  const auto stored = header.GetComponent();
  const bool isNifti = description.Format == "NIfTI" && (header.IsSingleFile() || header.IsOfPair());
  const bool isCompressed = header.IsSingleFile() ? header.IsCompressed() : HasEnding(ToLower(files.Voxels), ".gz");
  const Rescaling rescaling = header.GetRescaling();
  const bool      isSideBySide = header.CountComponentsSideBySide() > 1;
  const bool      isKnown = isSideBySide ? description.Kind != VoxelKind::Vector && !rescaling
                                         : description.Kind == VoxelKind::Scalar || description.Kind == VoxelKind::Vector;
  if (!isNifti || isCompressed || !stored || !header.HasDataOffset() || !isKnown || header.HoldsDisplacements())
  {
    return nullptr;
  }
  const auto layout = MakeLayout(header, files.Voxels, description);
  const auto section = layout.Sections.front();
  if ((description.Component != *stored && description.Component != GetMeantType(*stored, rescaling)) ||
      InputFile(files.Voxels).GetSize() < section.Offset + section.Size)
  {
    return nullptr;
  }
  return std::make_unique<NiftiReader>(files.Header, layout, description, rescaling);
}
