// SPDX-License-Identifier: Apache-2.0
#ifndef DicomSlice_h
#define DicomSlice_h

#include "dicom/DicomHeader.h"

#include <cstddef>

/** A slice of a volume: a frame of a file. */
struct DicomSlice
{
  const DicomHeader * Header;
  std::size_t         Frame;

  const DicomFrame &
  GetFrame() const
  {
    return Header->Frames[Frame];
  }
};

#endif
