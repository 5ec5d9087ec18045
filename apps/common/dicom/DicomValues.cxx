// SPDX-License-Identifier: Apache-2.0
#include "dicom/DicomValues.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <type_traits>

using itk::Subdivision::ElementType;

namespace
{
bool
IsRescaled(const DicomSlice & slice)
{
  return slice.Header->Samples == 1 && (slice.GetFrame().Slope != 1 || slice.GetFrame().Intercept != 0);
}

ElementType
GetStoredType(const DicomHeader & header)
{
  const int width = header.BitsAllocated == 8 ? 0 : header.BitsAllocated == 16 ? 2 : 4;
  return static_cast<ElementType>(static_cast<int>(ElementType::UInt8) + width + (header.IsSigned ? 1 : 0));
}

bool
IsWhole(double value)
{
  return value == std::nearbyint(value);
}

struct Range
{
  double Minimum = std::numeric_limits<double>::infinity();
  double Maximum = -std::numeric_limits<double>::infinity();

  void
  Include(double value)
  {
    Minimum = std::min(Minimum, value);
    Maximum = std::max(Maximum, value);
  }
};

/** The values that a slice can have. */
void
IncludeSlice(const DicomSlice & slice, Range & range)
{
  const DicomHeader & header = *slice.Header;
  const double        span = std::ldexp(1.0, static_cast<int>(header.BitsStored));
  const double        lowest = header.IsSigned ? -span / 2 : 0;
  const DicomFrame &  frame = slice.GetFrame();
  range.Include(frame.Slope * lowest + frame.Intercept);
  range.Include(frame.Slope * (lowest + span - 1) + frame.Intercept);
}

template <typename T>
bool
Holds(const Range & range)
{
  return range.Minimum >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
         range.Maximum <= static_cast<double>(std::numeric_limits<T>::max());
}

ElementType
ChooseIntegers(const Range & range)
{
  return Holds<std::int16_t>(range)    ? ElementType::Int16
         : Holds<std::uint16_t>(range) ? ElementType::UInt16
         : Holds<std::int32_t>(range)  ? ElementType::Int32
         : Holds<std::uint32_t>(range) ? ElementType::UInt32
                                       : ElementType::Double;
}

/** The bits above those stored may hold anything; a negative number has its sign in the highest stored one. */
template <typename T>
T
KeepStoredBits(T number, unsigned int bits)
{
  using Unsigned = std::make_unsigned_t<T>;
  const unsigned int unused = 8 * sizeof(T) - bits;
  const auto         moved = static_cast<T>(static_cast<Unsigned>(number) << unused);
  return static_cast<T>(moved >> unused); // arithmetic for signed numbers
}

template <typename TStored, typename TValue>
void
Convert(const DicomSlice & slice, const TStored * stored, std::size_t count, TValue * values)
{
  const DicomFrame & frame = slice.GetFrame();
  const unsigned int bits = slice.Header->BitsStored;
  if (IsRescaled(slice))
  {
    std::transform(stored, stored + count, values, [&frame, bits](TStored number) {
      return static_cast<TValue>(frame.Slope * KeepStoredBits(number, bits) + frame.Intercept);
    });
  }
  else
  {
    std::transform(stored, stored + count, values, [bits](TStored number) {
      return static_cast<TValue>(KeepStoredBits(number, bits));
    });
  }
}

[[noreturn]] void
Refuse(const DicomHeader & header, const std::string & reason)
{
  throw std::runtime_error(header.FileName.filename().string() + " " + reason);
}
} // namespace

void
CheckPixels(const DicomHeader & header)
{
  if (header.HasRealPixels)
  {
    Refuse(header,
           "holds pixels that are no integers (Float Pixel Data, or Double Float Pixel Data), which are not supported");
  }
  const std::string & colours = header.Photometric;
  const bool          isGrey = colours == "MONOCHROME1" || colours == "MONOCHROME2";
  if ((!isGrey || header.Samples != 1) && (colours != "RGB" || header.Samples != 3))
  {
    Refuse(header,
           "holds pixels of the kind " + colours + " with " + std::to_string(header.Samples) +
             " components; MONOCHROME1, MONOCHROME2 and RGB are supported (gdcmimg or dcmdjpeg convert others)");
  }
  if (header.BitsAllocated != 8 && header.BitsAllocated != 16 && header.BitsAllocated != 32)
  {
    Refuse(header, "holds pixels of " + std::to_string(header.BitsAllocated) + " bits; 8, 16 and 32 are supported");
  }
  // GDCM would put the bytes of both in a wrong order.
  if ((header.BitsAllocated > 8 && header.Samples > 1) || (header.BitsAllocated > 16 && header.IsBigEndian))
  {
    Refuse(header,
           std::string("holds ") + (header.Samples > 1 ? "colours" : "big-endian numbers") + " of " +
             std::to_string(header.BitsAllocated) + " bits, which are not supported");
  }
  if (header.BitsStored < 1 || header.BitsStored > header.BitsAllocated || header.HighBit + 1 != header.BitsStored)
  {
    Refuse(header,
           "stores " + std::to_string(header.BitsStored) + " bits up to bit " + std::to_string(header.HighBit) +
             " of each pixel, which is not supported");
  }
  if (header.Columns == 0 || header.Rows == 0)
  {
    Refuse(header, "is empty");
  }
  if (header.IsTruncated)
  {
    Refuse(header, "is truncated, or has no voxels");
  }
  for (const DicomFrame & frame : header.Frames)
  {
    if (frame.Slope == 0)
    {
      Refuse(header, "has the rescale slope 0");
    }
  }
}

ElementType
ChooseValueType(const std::vector<DicomSlice> & slices)
{
  const DicomHeader & first = *slices.front().Header;
  const auto          isAsStored = [&first](const DicomSlice & slice) {
    return !IsRescaled(slice) && GetStoredType(*slice.Header) == GetStoredType(first);
  };
  if (std::all_of(slices.begin(), slices.end(), isAsStored))
  {
    return GetStoredType(first);
  }
  Range range;
  bool  areIntegers = true;
  bool  areWide = false;
  for (const DicomSlice & slice : slices)
  {
    IncludeSlice(slice, range);
    areIntegers = areIntegers && IsWhole(slice.GetFrame().Slope) && IsWhole(slice.GetFrame().Intercept);
    areWide = areWide || slice.Header->BitsStored > std::numeric_limits<float>::digits;
  }
  return areIntegers ? ChooseIntegers(range) : areWide ? ElementType::Double : ElementType::Float;
}

void
ConvertToValues(const DicomSlice & slice, const void * stored, std::size_t count, ElementType type, void * values)
{
  WithElementType(GetStoredType(*slice.Header), [&](auto storedTag) {
    using Stored = typename decltype(storedTag)::Type;
    if constexpr (std::is_integral_v<Stored> && sizeof(Stored) <= 4)
    {
      WithElementType(type, [&](auto valueTag) {
        using Value = typename decltype(valueTag)::Type;
        Convert(slice, static_cast<const Stored *>(stored), count, static_cast<Value *>(values));
      });
    }
  });
}
