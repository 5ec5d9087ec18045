// SPDX-License-Identifier: Apache-2.0
// The programs' own readers and checks of NIfTI, VTK, JPEG and voxels as text, and their checks of lengths, on files
// that a fuzzer makes up. What is accepted must be what the bytes say when they are read by hand or by the C library.

#include "FuzzedFiles.h"

int
LLVMFuzzerTestOneInput(const std::uint8_t * const data, const std::size_t size)
{
  static const FuzzFolder folder;
  FuzzBytes               bytes(data, size);
  switch (bytes.Below(6))
  {
    case 0:
      FuzzNifti(bytes, folder);
      break;
    case 1:
      FuzzVtk(bytes, folder);
      break;
    case 2:
      FuzzTextNumbers(bytes);
      break;
    case 3:
      FuzzJpeg(bytes, folder);
      break;
    case 4:
      FuzzLength(bytes, folder);
      break;
    default:
      FuzzNiftiNames(bytes);
  }
  return 0;
}
