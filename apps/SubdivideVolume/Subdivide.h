// SPDX-License-Identifier: Apache-2.0
#ifndef Subdivide_h
#define Subdivide_h

#include "InputImage.h"
#include "Options.h"
#include "OutputImage.h"
#include "PixelComponent.h"
#include "Progress.h"

/** One image to subdivide. */
struct SubdivisionJob
{
  const ::Options &  Options;
  const InputImage & Input;
  OutputImage &      Output;
  PixelComponent     OutputComponent;
  ::Progress &       Progress;
};

/** What came of it. */
struct SubdivisionReport
{
  ImageGrid   InputGrid;
  ImageGrid   OutputGrid;
  PixelRange  InputRange;
  PixelRange  OutputRange;
  std::size_t NumberOfPieces = 0;
};

/** Reads, subdivides and writes an image, piece by piece, and leaves giving the file its name to the caller.
 * \tparam TComponent the type of the input's components */
template <typename TComponent>
SubdivisionReport
Subdivide(const SubdivisionJob & job);

#endif
