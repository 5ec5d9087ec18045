// SPDX-License-Identifier: Apache-2.0
#include "itk/ItkReader.h"
#include "headers/DataOwners.h"
#include "itk/Bitmap.h"
#include "itk/FileIntegrity.h"
#include "itk/FileLength.h"
#include "itk/ItkDescription.h"
#include "itk/JpegIntegrity.h"
#include "itk/LibraryReason.h"
#include "itk/PictureColours.h"
#include "itk/VtkFile.h"
#include "nifti/NiftiFiles.h"
#include "nifti/NiftiHeader.h"
#include "system/files/InputFile.h"
#include "system/process/WatchedTask.h"
#include "text/HeaderText.h"
#include "volumes/BoxRuns.h"

#include "itkImageFileReader.h" // registers the formats

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace
{
using itk::Subdivision::Box;

/** Whether ITK's reader of the format reads a region right, without the rest. */
bool
ReadsRegions(const itk::ImageIOBase & imageIO)
{
  // It mixes up the components of a region's vectors.
  const bool isVectorNifti =
    std::string(imageIO.GetNameOfClass()) == "NiftiImageIO" && imageIO.GetNumberOfComponents() > 1;
  return const_cast<itk::ImageIOBase &>(imageIO).CanStreamRead() && !isVectorNifti;
}

/** A reader for the format that a file's first bytes show. Some of those that look at them fail at an early end. */
itk::ImageIOBase::Pointer
FindByContent(const std::string & path)
{
  try
  {
    return itk::ImageIOFactory::CreateImageIO(path.c_str(), itk::IOFileModeEnum::ReadMode);
  }
  catch (const itk::ExceptionObject &)
  {
    return nullptr;
  }
}

/** A reader for the format that a name's ending says; ITK itself knows some endings in small letters only. */
itk::ImageIOBase::Pointer
FindByEnding(const std::string & path)
{
  const std::string ending = ToLower(std::filesystem::path(path).extension().string());
  for (const auto & object : itk::ObjectFactoryBase::CreateAllInstance("itkImageIOBase"))
  {
    auto * const imageIO = dynamic_cast<itk::ImageIOBase *>(object.GetPointer());
    if (imageIO == nullptr)
    {
      continue;
    }
    const auto & known = imageIO->GetSupportedReadExtensions();
    if (std::find(known.begin(), known.end(), ending) != known.end())
    {
      return imageIO;
    }
  }
  return nullptr;
}

/** The ending in small letters under which ITK reads a file whose own it does not know; empty if it knows that. GIPL's
 * reader lists no endings, and finds out by them whether the file is compressed. */
std::string
GetKnownEnding(const std::string & path)
{
  const std::string name = std::filesystem::path(path).filename().string();
  for (const std::string ending : { ".gipl", ".gipl.gz" })
  {
    const std::size_t length = std::min(name.size(), ending.size());
    const std::string own = name.substr(name.size() - length);
    if (own != ending && ToLower(own) == ending)
    {
      return ending;
    }
  }
  return GetMistakenNiftiEnding(path);
}

/** Calls ITK, some of whose libraries throw what is no std::exception, as HDF5's does. */
template <typename TFunction>
void
CallLibrary(const std::string & path, TFunction && function)
{
  try
  {
    function();
  }
  catch (const std::exception &)
  {
    throw;
  }
  catch (...)
  {
    FailToRead(path, "it is damaged: the library of its format cannot read it");
  }
}

/** Whether a file is HDF5, whatever it holds. */
bool
IsHdf5(const std::string & path)
{
  const std::string sign = "\x89HDF\r\n\x1A\n";
  return InputFile(path).ReadTextAt(0, sign.size()) == sign;
}

void
CheckNiftiPlacement(const std::string & path)
{
  const NiftiPlacement placement = ReadNiftiHeader(path).GetPlacement();
  const std::string    fault = placement.FindFault();
  if (!placement.IsFinite())
  {
    FailToRead(path,
               "its placement (qform or sform) has numbers that are not finite; --raw reads it without its header");
  }
  if (!fault.empty())
  {
    FailToRead(path, fault);
  }
}

/** Why ITK did not read a header. */
std::string
GetHeaderFault(const itk::ExceptionObject & error, const std::string & path, const bool isNifti)
{
  const std::string reason = GetReason(error, path);
  if (isNifti && reason.find("orthonormal") != std::string::npos)
  {
    return ReadNiftiHeader(path).GetPlacement().ExplainRefusal();
  }
  return IsHdf5(path) ? "it is damaged (" + reason + ')' : reason;
}

bool
IsWhole(const std::vector<std::uint64_t> & size, const Box & box)
{
  for (std::size_t axis = 0; axis < size.size(); ++axis)
  {
    if (box[axis].First != 0 || box[axis].Size != size[axis])
    {
      return false;
    }
  }
  return true;
}
} // namespace

ItkReader::ItkReader(const std::string & path, const std::string & meantFormat, const WarningSink & warn)
  : m_Path(path)
{
  const WatchedTask task("cannot read " + path);
  if (HasNiftiEndingInMixedCase(path))
  {
    FailToRead(path, "NIfTI files' endings are in small letters or in capitals, not in both; rename it");
  }
  if (IsNiftiPair(path))
  {
    FindNiftiPair(path); // says which file of the two is not there
  }
  InputFile{ path }; // says why it cannot be opened, and keeps pipes from being waited for
  const std::string fault = FindJpegFault(path);
  if (!fault.empty())
  {
    FailToRead(path, "it is damaged or truncated (" + fault + ")");
  }
  const std::string known = GetKnownEnding(path);
  m_Links = known.empty() ? nullptr : LinkFolder::Get();
  m_Name = m_Links == nullptr ? path : m_Links->Link(path, known);
  m_ImageIO = FindByContent(m_Name);
  const std::string ending = std::filesystem::path(path).extension().string();
  if (m_ImageIO.IsNull() && ending != ToLower(ending))
  {
    m_ImageIO = FindByEnding(path);
  }
  if (m_ImageIO.IsNull() && NiftiHeader(path).IsOfVersion2())
  {
    FailToRead(path, "it is a NIfTI-2 file, of which only version 1 is supported; save it as NIfTI-1 or NRRD");
  }
  if (m_ImageIO.IsNull() && IsHdf5(path))
  {
    FailToRead(
      path, "it is an HDF5 file that holds no image as ITK writes it, or is damaged; save its array as .nrrd or .mha");
  }
  if (m_ImageIO.IsNull())
  {
    FailToRead(
      path,
      (meantFormat.empty()
         ? std::string("it is in none of the known image formats")
         : "it is no " + meantFormat + " file, or is damaged at its start, and is in none of the other known formats") +
        ", which SubdivideVolume --formats lists; --raw reads voxels without a header");
  }
  const std::string library = m_ImageIO->GetNameOfClass();
  if (library == "MRCImageIO")
  {
    CheckMrcByteOrder(path);
  }
  if (library == "NiftiImageIO")
  {
    CheckNiftiPlacement(path);
  }
  this->ReadHeader();
  const std::string colourFault = FindColourFault(*m_ImageIO);
  if (!colourFault.empty())
  {
    FailToRead(path, colourFault);
  }
  m_Description = DescribeByItk(path, *m_ImageIO, warn);
  m_ReadsParts = ReadsRegions(*m_ImageIO);
  if (library != "VTKImageIO")
  {
    CallLibrary(path, [&] { CheckFileIsWhole(path, *m_ImageIO); });
  }
  else if (m_ImageIO->GetFileType() == itk::IOFileEnum::ASCII)
  {
    m_Whole = ReadVtkText(path, m_Description, warn);
  }
  else
  {
    CheckVtkVoxels(path, m_Description, warn);
  }
}

std::vector<std::string>
ItkReader::GetFiles() const
{
  if (IsNiftiPair(m_Path))
  {
    const NiftiPair files = FindNiftiPair(m_Path);
    return { files.Header, files.Voxels };
  }
  std::vector<std::string> files = { m_Path };
  if (m_Description.Format == "NRRD")
  {
    const auto data = ListDataFiles(m_Path);
    files.insert(files.end(), data.begin(), data.end());
  }
  return files;
}

void
ItkReader::ReadHeader()
{
  try
  {
    if (std::string(m_ImageIO->GetNameOfClass()) == "BMPImageIO")
    {
      m_ImageIO = OpenBitmap(m_Name);
    }
    else
    {
      CallLibrary(m_Path, [&] {
        m_ImageIO->SetFileName(m_Name);
        m_ImageIO->ReadImageInformation();
      });
    }
  }
  catch (const itk::ExceptionObject & error)
  {
    FailToRead(m_Path, GetHeaderFault(error, m_Path, m_ImageIO->GetNameOfClass() == std::string("NiftiImageIO")));
  }
}

ItkReader::~ItkReader()
{
  const WatchedTask task("cannot read " + m_Path);
  m_ImageIO = nullptr;
}

bool
ItkReader::ReadsParts() const
{
  return m_ReadsParts;
}

std::uint64_t
ItkReader::GetScratchBytes(std::uint64_t partBytes) const
{
  return partBytes; // several of the formats' readers read into an array of their own
}

void
ItkReader::ReadRegion(const Box & box, void * voxels)
{
  const WatchedTask task("cannot read " + m_Path);
  if (m_HasReadWhole && !m_ReadsParts)
  {
    // GIPL's reader goes on where it stands, which is the end of the file, and NIfTI's does not free what it has read.
    m_ImageIO = dynamic_cast<itk::ImageIOBase *>(m_ImageIO->CreateAnother().GetPointer());
    this->ReadHeader();
  }
  m_HasReadWhole = true;
  itk::ImageIORegion region(static_cast<unsigned int>(box.size()));
  for (unsigned int axis = 0; axis < box.size(); ++axis)
  {
    region.SetIndex(axis, box[axis].First);
    region.SetSize(axis, box[axis].Size);
  }
  try
  {
    CallLibrary(m_Path, [&] {
      m_ImageIO->SetIORegion(region);
      m_ImageIO->Read(voxels);
    });
  }
  catch (const itk::ExceptionObject & error)
  {
    const std::string & format = m_Description.Format;
    const bool          isPicture = format == "PNG" || format == "JPEG" || format == "BMP";
    FailToRead(m_Path,
               isPicture ? "its pixels cannot be decoded; it is damaged or truncated" : GetReason(error, m_Path));
  }
}

void
ItkReader::Read(const Box & box, void * voxels)
{
  const std::vector<std::uint64_t> & size = m_Description.Grid.Size;
  if (m_ReadsParts || (IsWhole(size, box) && m_Whole.empty()))
  {
    this->ReadRegion(box, voxels);
    return;
  }
  const std::uint64_t voxelBytes = m_Description.GetVoxelBytes();
  if (m_Whole.empty())
  {
    m_Whole.resize(static_cast<std::size_t>(m_Description.GetNumberOfVoxels() * voxelBytes));
    Box whole;
    for (const std::uint64_t count : size)
    {
      whole.push_back({ 0, count });
    }
    this->ReadRegion(whole, m_Whole.data());
  }
  char * bytes = static_cast<char *>(voxels);
  ForEachRun(size, box, [&](std::uint64_t first, std::uint64_t count) {
    std::memcpy(bytes, m_Whole.data() + first * voxelBytes, count * voxelBytes);
    bytes += count * voxelBytes;
  });
}
