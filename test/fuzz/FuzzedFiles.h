// SPDX-License-Identifier: Apache-2.0
#ifndef FuzzedFiles_h
#define FuzzedFiles_h

#include "FuzzBytes.h"
#include "FuzzFolder.h"

#include "NonOscillatorySubdivision/ElementType.h"

#include <stdexcept>
#include <string>

// What FileFuzz runs: each function makes files of what a fuzzer offers, has them read and checked, and ends the
// program where that is not what the bytes themselves say.

void
FuzzNifti(FuzzBytes & bytes, const FuzzFolder & folder);

/** The names of NIfTI's files. */
void
FuzzNiftiNames(FuzzBytes & bytes);

void
FuzzVtk(FuzzBytes & bytes, const FuzzFolder & folder);

void
FuzzTextNumbers(FuzzBytes & bytes);

void
FuzzJpeg(FuzzBytes & bytes, const FuzzFolder & folder);

/** Of formats whose headers are checked here and read by ITK. */
void
FuzzLength(FuzzBytes & bytes, const FuzzFolder & folder);

/** Whether a function refuses a file; nothing else than a std::runtime_error may do that. */
template <typename TFunction>
bool
IsRefused(TFunction && function)
{
  try
  {
    function();
    return false;
  }
  catch (const std::runtime_error &)
  {
    return true;
  }
}

/** What a word of a text is as a voxel, by the C library. */
struct FuzzedWord
{
  bool        IsOpen = false; // a word such as nan or 0x1p3, which may be refused
  bool        IsNumber = false;
  std::string Bytes; // of the number
};

FuzzedWord
ReadFuzzedWord(const std::string & word, itk::Subdivision::ElementType type);

/** Whether voxels are those of a word; all that is not a number is alike. */
bool
AreBytesOf(const FuzzedWord & word, itk::Subdivision::ElementType type, const char * bytes);

itk::Subdivision::ElementType
ChooseElementType(FuzzBytes & bytes);

/** Number as bytes, the lowest first. */
inline std::uint64_t
GetLittleEndian(const std::string & text, const std::size_t place, const std::size_t size)
{
  std::uint64_t number = 0;
  for (std::size_t i = size; i-- > 0;)
  {
    number = 256 * number + static_cast<unsigned char>(text[place + i]);
  }
  return number;
}

#endif
