// SPDX-License-Identifier: Apache-2.0
#ifndef TiffStack_h
#define TiffStack_h

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/** How the planes of a TIFF file make a stack, as ImageJ, OME or the tags say. */
struct TiffStack
{
  std::uint64_t                        Slices = 1;
  std::uint64_t                        Channels = 1;
  std::uint64_t                        Frames = 1;
  std::vector<std::uint64_t>           Planes; // where plane (frame * Slices + slice) * Channels + channel lies
  std::array<std::optional<double>, 3> Spacing;
  bool                                 IsInMillimetres = false; // else the file does not say what the unit is
  bool                                 HasOtherUnit = false;    // a resolution without a unit: it says no spacing
  bool                                 IsImageJ = false;
  bool                                 HoldsInt16 = false;     // ImageJ's calibration turns uint16 into int16
  bool                                 HasCalibration = false; // another one, of the values
};

/** Millimetres in a unit of length, if it is known. */
std::optional<double>
GetMillimetres(const std::string & unit);

/** The number of a stack's planes, each of which is a page of the file.
 * \throw std::runtime_error with a reason alone, here and below, if there are more than any file has */
std::uint64_t
CountPlanes(const TiffStack & stack);

/** What a text says of the stack if it is ImageJ's. */
std::optional<TiffStack>
ParseImageJ(const std::string & text);

/** What a text says of the stack if it is OME's XML. */
std::optional<TiffStack>
ParseOme(const std::string & text, std::uint64_t pages);

#endif
