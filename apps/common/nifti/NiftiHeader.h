// SPDX-License-Identifier: Apache-2.0
#ifndef NiftiHeader_h
#define NiftiHeader_h

#include "nifti/NiftiPlacement.h"
#include "volumes/ImageDescription.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

/** Numbers of the header of a NIfTI-1 file, or of an Analyze one, in either byte order. */
class NiftiHeader
{
public:
  /** Reads what is there of it, compressed or not. */
  explicit NiftiHeader(const std::string & path);

  /** Whether it is a header of version 1 at all, and its voxels follow in the same file. */
  bool
  IsSingleFile() const;

  /** Whether it is a header of version 1 or of Analyze at all: both start with their size. */
  bool
  IsOfPair() const;

  /** Whether it is a header of version 2. */
  bool
  IsOfVersion2() const;

  /** Whether the header's file, and so the voxels of a single file, is a compressed stream. */
  bool
  IsCompressed() const
  {
    return m_IsCompressed;
  }

  bool
  IsBigEndian() const;

  /** The type of the stored components; nothing for those that are no whole bytes, or of 128 bits. */
  std::optional<itk::Subdivision::ElementType>
  GetComponent() const;

  /** How many components of a voxel stand side by side; 1 where each has a volume of its own. */
  unsigned int
  CountComponentsSideBySide() const;

  /** Whether the components are displacements: some versions of ITK turn their signs. */
  bool
  HoldsDisplacements() const;

  /** Slope and intercept by which stored values become those that are meant, if they change any. */
  std::optional<std::pair<double, double>>
  GetRescaling() const;

  /** Whether ITK rescales by them: it takes what is below 2.2e-16 for none. */
  bool
  IsRescaledByItk() const;

  /** Whether the place of the voxels is counted from the start of their file. */
  bool
  HasDataOffset() const;

  /** Bytes before the voxels. */
  std::uint64_t
  GetDataOffset() const;

  /** Bytes of the voxels; of more than any file has, some such number. */
  std::uint64_t
  GetDataBytes() const;

  /** Completes a grid whose spacing alone is in millimetres, and whose fourth axis starts at 0 and is in the header's
   * unit: the origin becomes millimetres, and time becomes seconds from the header's start on. */
  void
  CompleteUnits(ImageGrid & grid) const;

  /** What of it contradicts the rest, or readers take in different ways, so that none can be right; empty if nothing.
   */
  std::string
  FindFault() const;

  /** What SPM writes into fields that Analyze itself does not use, in words: a scale factor and an origin. Empty if
   * nothing, or if it is NIfTI. */
  std::string
  FindSpmParts() const;

  /** Where it places the voxels. Analyze does not. */
  NiftiPlacement
  GetPlacement() const;

private:
  template <typename T>
  T
  Get(std::size_t offset) const;
  std::string
  FindComponentFault() const;
  bool
  IsNifti() const;

  static constexpr std::size_t Size = 348;
  std::array<char, Size>       m_Bytes{};
  bool                         m_IsComplete = false;
  bool                         m_IsSwapped = false;
  bool                         m_IsCompressed = false;
};

/** Whether a file, compressed or not, starts with a header of NIfTI of either version, or of Analyze. */
bool
IsNiftiHeader(const std::string & path);

/** The header of an image, which may be named by the file of its voxels. */
NiftiHeader
ReadNiftiHeader(const std::string & path);

#endif
